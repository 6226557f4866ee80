#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace armloom {

// A subcommand; `run` returns the exit code.
struct Command {
  CLI::App* parser;
  std::function<int()> run;
};

[[nodiscard]] Command serve_command(CLI::App& app);
[[nodiscard]] std::vector<Command> remote_commands(CLI::App& app);  // for a running server
[[nodiscard]] std::vector<Command> add_commands(CLI::App& app);

[[nodiscard]] std::vector<std::string> job_states();

}  // namespace armloom
