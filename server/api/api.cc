#include "server/api/api.h"

#include <utility>

#include "server/api/route.h"

namespace armloom {

void Api::add_routes(Router& router) {
  for (const Route& route : all_routes()) {
    if (route.run == nullptr) continue;
    std::vector<std::string> parameters;
    for (const Parameter& parameter : route.parameters) {
      if (std::string_view(parameter.in) == "query") parameters.push_back(parameter.name);
    }
    router.add(
        route.method, route.path, route.rights(),
        [this, run = route.run](const Request& request, const Router::Arguments& arguments,
                                Respond respond) {
          run(Call{parts_, meshes_, recordings_, request, arguments, std::move(respond)});
        },
        std::move(parameters));
  }
}

}  // namespace armloom
