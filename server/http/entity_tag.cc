#include "server/http/entity_tag.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace armloom {

std::string tag_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  char text[40];
  std::snprintf(text, sizeof text, "%zx-%016llx", bytes.size(),
                static_cast<unsigned long long>(hash));
  return text;
}

bool any_tag(std::string_view field, const std::function<bool(std::string_view)>& fits) {
  while (!field.empty()) {
    std::string_view one = field.substr(0, field.find(','));
    field.remove_prefix(std::min(field.size(), one.size() + 1));
    while (one.starts_with(' ') || one.starts_with('\t')) one.remove_prefix(1);
    while (one.ends_with(' ') || one.ends_with('\t')) one.remove_suffix(1);
    if (fits(one)) return true;
  }
  return false;
}

}  // namespace armloom
