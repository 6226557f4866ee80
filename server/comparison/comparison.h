#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/worker.h"
#include "core/model/cell.h"
#include "server/comparison/jobs_at_hand.h"
#include "server/messages/comparison.h"

namespace armloom {

// What the same jobs would have come to under other policies: each is run in simulation, one after
// the other, on a thread of its own that gives way to all others. One comparison at a time; the
// last one is kept. On the server's thread.
class Comparison {
 public:
  // More evaluations than this and a run is given up: on one core some minutes.
  inline static constexpr std::uint64_t kEvaluationsMax = 50'000'000;

  // `post`: to the server's thread; it outlives this.
  Comparison(CellPtr cell, std::function<void(std::function<void()>)> post);
  ~Comparison();  // waits until the run has noticed

  struct Question {
    ComparisonInquiry inquiry;
    JobsAtHand::Taken taken;
    std::vector<CollisionObject> objects;  // of the scene as it is
    std::string in_force;                  // the policy
  };
  // Problems: conflict, while one is under way, or when there is no job.
  [[nodiscard]] Result<ComparisonView> start(Question question);
  [[nodiscard]] const std::optional<ComparisonView>& latest() const { return latest_; }
  // One that is under way ends as canceled, with the runs that are done.
  void cancel();

 private:
  using Cancelled = std::shared_ptr<std::atomic<bool>>;
  void compare(const Question& question, const std::vector<std::string>& policies,
               const Cancelled& cancelled);
  void tell(const Cancelled& of, std::function<void(ComparisonView&)> change);

  CellPtr cell_;
  std::function<void(std::function<void()>)> post_;
  std::optional<ComparisonView> latest_;
  Cancelled cancelled_;  // of the latest one
  Worker worker_;
};

}  // namespace armloom
