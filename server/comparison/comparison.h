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

// Compares scheduling policies: simulates the same jobs under each policy, one after the other, on
// a thread of lowest priority. Runs one comparison at a time and keeps the latest. Use on the
// server's thread.
class Comparison {
 public:
  // Number of collision evaluations after which a simulation gives up: some minutes on one core.
  inline static constexpr std::uint64_t kEvaluationsMax = 50'000'000;

  // `post` runs a task on the server's thread, which must outlive the Comparison.
  Comparison(CellPtr cell, std::function<void(std::function<void()>)> post);
  ~Comparison();  // waits for the thread

  struct Question {
    ComparisonInquiry inquiry;
    JobsAtHand::Taken taken;
    std::vector<CollisionObject> objects;  // of the present scene
    std::string in_force;                  // present policy
  };
  // Problem (conflict): a comparison is under way, or there are no jobs.
  [[nodiscard]] Result<ComparisonView> start(Question question);
  [[nodiscard]] const std::optional<ComparisonView>& latest() const { return latest_; }
  // Cancels a comparison under way. Its finished runs are kept.
  void cancel();

 private:
  using Cancelled = std::shared_ptr<std::atomic<bool>>;
  void compare(const Question& question, const std::vector<std::string>& policies,
               const Cancelled& cancelled);
  void tell(const Cancelled& of, std::function<void(ComparisonView&)> change);

  CellPtr cell_;
  std::function<void(std::function<void()>)> post_;
  std::optional<ComparisonView> latest_;
  Cancelled cancelled_;  // of latest_
  Worker worker_;
};

}  // namespace armloom
