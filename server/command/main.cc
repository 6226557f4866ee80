#include <algorithm>
#include <exception>
#include <iostream>

#include "server/command/command.h"
#include "server/command/command_line.h"

namespace {

using namespace armloom;

int run(int argc, char** argv) {
  CLI::App app("Armloom: an execution server for robot cells with several arms");
  app.require_subcommand(1);
  app.set_version_flag("--version", "armloom " ARMLOOM_VERSION);
  const std::vector<Command> commands = add_commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitBadInput;
  }
  const auto asked = std::ranges::find_if(
      commands, [](const Command& command) { return command.parser->parsed(); });
  return asked->run();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "armloom: stopped by an internal error: " << error.what() << '\n';
    return 70;  // EX_SOFTWARE
  }
}
