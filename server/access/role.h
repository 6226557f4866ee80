#pragma once

#include <optional>
#include <string_view>

namespace armloom {

// Role of a client: its permissions. Each role includes the roles before it.
enum class Role {
  viewer,   // read
  operate,  // move and stop arms, change the scene
  admin,    // read the audit trail
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
