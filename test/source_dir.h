#pragma once

#include <string>

namespace armloom {

// The folder of this source tree, absolute: where models, cells and the tests' own data are. A
// function, as its text then stands in one object: two trees share all others in a cache of
// compiled files.
std::string source_dir();

}  // namespace armloom
