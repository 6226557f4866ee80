#include "server/codec/format.h"

namespace armloom {

Schema as_json(double number) {
  JsonWriter out;
  out.value(number);
  return Schema::parse(out.text());
}

}  // namespace armloom
