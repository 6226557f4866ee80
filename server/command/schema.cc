#include <iostream>

#include "server/api/openapi.h"
#include "server/codec/cell_schema.h"
#include "server/command/command.h"

namespace armloom {

int print_cell_schema(bool markdown) {
  std::cout << (markdown ? cell_reference_text() : cell_schema_text()) << std::flush;
  return kExitDone;
}

int print_openapi() {
  std::cout << openapi_text() << std::flush;
  return kExitDone;
}

}  // namespace armloom
