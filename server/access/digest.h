#pragma once

#include <string>
#include <string_view>

namespace armloom {

// SHA-256, as 64 small hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view text);
// 256 random bits that nobody can guess, likewise.
[[nodiscard]] std::string random_hex();
// In a time that does not depend on where they differ.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace armloom
