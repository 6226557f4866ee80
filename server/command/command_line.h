#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace armloom {

// A command of the program: its parser, and the function that runs it and returns the exit code.
struct Command {
  CLI::App* parser;
  std::function<int()> run;
};

// Adds `serve`, which has the most options.
[[nodiscard]] Command serve_command(CLI::App& app);
// Adds all commands with their options.
[[nodiscard]] std::vector<Command> add_commands(CLI::App& app);

}  // namespace armloom
