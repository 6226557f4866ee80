#pragma once

#include <cstdint>
#include <memory>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Drives an executive by hand: the caller decides when a control cycle runs and when an answer
// arrives. Verdicts and plans are computed when they are requested here. Single-threaded.
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
  // Compute and deliver the answer to an open question. No effect if none is open.
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
