#pragma once

#include <string>
#include <string_view>

namespace armloom {

// Returns the SHA-256 of `text` as 64 lowercase hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view text);
// Returns 256 unpredictable random bits as 64 lowercase hexadecimal digits.
[[nodiscard]] std::string random_hex();
// Compares two texts in a time that does not depend on where they differ.
[[nodiscard]] bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace armloom
