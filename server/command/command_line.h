#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace armloom {

// A command of the program, and what does it when it was asked for: its exit code.
struct Command {
  CLI::App* parser;
  std::function<int()> run;
};

// `serve`, which has the most options.
[[nodiscard]] Command serve_command(CLI::App& app);
// All of them, with their options.
[[nodiscard]] std::vector<Command> add_commands(CLI::App& app);

}  // namespace armloom
