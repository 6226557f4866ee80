#include "core/base/plain_name.h"

#include <algorithm>

namespace armloom {

bool is_plain_name(std::string_view name) {
  const bool plain = std::ranges::none_of(name, [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/' || c == '\\';
  });
  return plain && !name.empty() && characters(name) <= kPlainNameMax && name != "." && name != "..";
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace armloom
