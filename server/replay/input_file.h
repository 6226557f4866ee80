#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "core/executive/executive_input.h"
#include "server/replay/input_format.h"

namespace armloom {

// Writes inputs.jsonl of a recording. Each input is written before the events that the input
// causes.
class InputFile final : public InputLog {
 public:
  static constexpr const char* kName = "inputs.jsonl";

  // `post` runs a task on the thread that writes events, in order. `alarm` is called on that
  // thread, once, if the file can no longer be written. Problem (unavailable): the file cannot be
  // created.
  struct Parts {
    std::function<void(std::function<void()>)> post;
    std::function<void(const std::string&)> alarm;  // may be null
  };
  [[nodiscard]] static Result<std::unique_ptr<InputFile>> create(
      const std::filesystem::path& folder, const InputLogHead& head, Parts parts);

  void came(std::uint64_t ticks, const ExecutiveInput& input) override;

 private:
  explicit InputFile(Parts parts) : parts_(std::move(parts)) {}
  void write(const std::string& line);

  Parts parts_;
  std::ofstream file_;
  bool said_lost_ = false;
};

}  // namespace armloom
