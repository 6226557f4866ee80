#include "server/http/request_id.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <random>

namespace armloom {

bool is_request_id(std::string_view text) {
  const auto may_stand = [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return letter || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= kRequestIdMax && std::ranges::all_of(text, may_stand);
}

std::string fresh_request_id() {
  static const std::uint32_t process = std::random_device{}();
  static std::atomic<std::uint64_t> count{0};
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%08x-%06llx", process,
                static_cast<unsigned long long>(++count));
  return text.data();
}

}  // namespace armloom
