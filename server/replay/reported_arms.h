#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/arm/make_controller.h"
#include "core/executive/executive_input.h"

namespace armloom {

// Returns controllers that pass all reports of `types` on and record them in `inputs`, which
// outlives the controllers. A report is recorded with the number of the cycles before the one that
// takes it.
[[nodiscard]] ControllerTypes recorded(ControllerTypes types, InputLog& inputs);

// Controllers of a replay: they report what was recorded, and ignore commands.
class ReportedArms {
 public:
  // Returns the type "remote". The controllers need this object.
  [[nodiscard]] ControllerTypes controllers();
  // The controller of the arm returns the event in the next cycle. Throws std::invalid_argument if
  // the arm has no such controller.
  void add(const ExecutiveInput::Reported& in);
  void add(const ExecutiveInput::Connected& in);

 private:
  using Event = std::variant<ArmFeedback, ArmConnection>;
  class Arm;
  void add(const std::string& arm, Event event);

  std::map<std::string, std::shared_ptr<std::deque<Event>>> events_;  // by arm
};

}  // namespace armloom
