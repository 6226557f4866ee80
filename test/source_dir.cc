#include "test/source_dir.h"

namespace armloom {

std::string source_dir() { return ARMLOOM_SOURCE_DIR; }

}  // namespace armloom
