#pragma once

#include <optional>
#include <string_view>

namespace armloom {

// What a client may do; each may what those before it may, too.
enum class Role {
  viewer,   // look
  operate,  // and move arms, stop them, change the scene
  admin,    // and see who did what
};
// "viewer", "operator", "admin"
[[nodiscard]] constexpr const char* to_string(Role role) {
  switch (role) {
    case Role::viewer:
      return "viewer";
    case Role::operate:
      return "operator";
    case Role::admin:
      return "admin";
  }
  return nullptr;
}

}  // namespace armloom
