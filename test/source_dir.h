#pragma once

#include <string>

namespace armloom {

// Returns the absolute path of this source tree, with the models, the cells and the tests' own
// data. As a function its text is in one object file only, so that two trees share all other
// objects in a compiler cache.
std::string source_dir();

}  // namespace armloom
