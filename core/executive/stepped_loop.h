#pragma once

#include <cstdint>
#include <memory>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Drives an executive by hand: its cycles, and when what it asks for is answered. Verdicts and
// plans are computed then. On one thread.
class SteppedLoop {
 public:
  // `options.starts` is set here. Problems: those of Executive::create(). The observer outlives it.
  [[nodiscard]] static Result<std::unique_ptr<SteppedLoop>> create(CellPtr cell,
                                                                   ExecutiveOptions options,
                                                                   Observer& observer);
  ~SteppedLoop();

  [[nodiscard]] Executive& executive();
  void tick();
  [[nodiscard]] std::uint64_t ticks() const;  // so many
  [[nodiscard]] TimePoint next() const;       // the time of the next one
  // Nothing happens where nothing is open.
  void answer_question(bool interrupted = false);
  void answer_certify();
  void answer_plan();           // the one that has been open for longest
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
