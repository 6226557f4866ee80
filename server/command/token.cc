#include <iostream>

#include "core/base/enumeration.h"
#include "server/access/token_file.h"
#include "server/command/command.h"

namespace armloom {
namespace {

int list(const TokenFile& file) {
  const auto tokens = file.read();
  if (!tokens) return refuse("", tokens.error());
  for (const KeptToken& token : *tokens) {
    std::cout << token.name << ' ' << to_string(token.role) << ' ' << token.made_at << '\n';
  }
  return kExitDone;
}

int add(TokenFile& file, const TokenOptions& options) {
  const auto role = value_named<Role>(options.role);
  if (!role) {
    return refuse("", {Problem{ProblemKind::invalid, "bad-role", "--role",
                               "the role must be viewer, operator or admin", options.role}});
  }
  const auto token = file.add(options.name, *role);
  if (!token) return refuse("", token.error());
  std::cout << *token << std::endl;
  std::cerr << "armloom: keep this token; it cannot be shown again\n";
  return kExitDone;
}

}  // namespace

int change_tokens(const TokenOptions& options) {
  TokenFile file(options.file);
  switch (options.what) {
    case TokenOptions::What::add:
      return add(file, options);
    case TokenOptions::What::list:
      return list(file);
    case TokenOptions::What::revoke:
      break;
  }
  const auto revoked = file.revoke(options.name);
  return revoked ? kExitDone : refuse("", revoked.error());
}

}  // namespace armloom
