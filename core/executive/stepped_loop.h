#pragma once

#include <cstdint>
#include <memory>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Drives an executive by hand: control cycles, and the times of answers. Verdicts and plans are
// computed on demand. Single-threaded.
class SteppedLoop {
 public:
  // Sets `options.starts`. Problems: those of Executive::create(). `observer` outlives the loop.
  [[nodiscard]] static Result<std::unique_ptr<SteppedLoop>> create(CellPtr cell,
                                                                   ExecutiveOptions options,
                                                                   Observer& observer);
  ~SteppedLoop();

  [[nodiscard]] Executive& executive();
  void tick();
  [[nodiscard]] std::uint64_t ticks() const;
  [[nodiscard]] TimePoint next() const;
  // No effect if nothing is open.
  void answer_question(bool interrupted = false);
  void answer_certify();
  void answer_plan();           // the oldest open plan
  void write_start(JobId job);  // StartLog

 private:
  class Service;
  explicit SteppedLoop(std::unique_ptr<Service> service);
  std::unique_ptr<Service> service_;
  std::unique_ptr<Executive> executive_;
  std::uint64_t ticks_ = 0;
  TimePoint next_{};
};

}  // namespace armloom
