#include "server/access/role.h"

namespace armloom {

const char* to_string(Role role) {
  switch (role) {
    case Role::viewer:
      return "viewer";
    case Role::operate:
      return "operator";
    case Role::admin:
      return "admin";
  }
  return "";
}

std::optional<Role> role_named(std::string_view name) {
  for (const Role role : {Role::viewer, Role::operate, Role::admin}) {
    if (name == to_string(role)) return role;
  }
  return std::nullopt;
}

}  // namespace armloom
