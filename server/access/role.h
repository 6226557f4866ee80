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
[[nodiscard]] const char* to_string(Role role);
[[nodiscard]] std::optional<Role> role_named(std::string_view name);

}  // namespace armloom
