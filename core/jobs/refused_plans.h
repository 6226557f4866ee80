#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "core/jobs/inputs.h"

namespace armloom {

// The questions for which no path was found in the present scene. A question is known if the start,
// the goal, and the positions of the arms that the path had to avoid are the same. The seed is
// ignored.
class RefusedPlans {
 public:
  // Returns why there is no path, null if that is not known.
  [[nodiscard]] const NoPlan* find(const Cell& cell, const PlanQuestion& question) const {
    return find(cell, question, question.may_move);
  }
  // Returns true if no path past PlanQuestion::may_move was found.
  [[nodiscard]] bool has_no_way_past(const Cell& cell, const PlanQuestion& question) const;
  void learn(const Cell& cell, const PlanQuestion& question, const PlanMade& answer);

  inline static constexpr std::size_t kMax = 64;  // the oldest are dropped

 private:
  struct Refused {
    MotionGoal goal;
    Configuration at;
    std::vector<ArmId> left_out;
    NoPlan why;
  };
  void add(const Cell& cell, const PlanQuestion& question, const std::vector<ArmId>& left_out,
           const NoPlan& why);
  [[nodiscard]] const NoPlan* find(const Cell& cell, const PlanQuestion& question,
                                   const std::vector<ArmId>& left_out,
                                   bool only_sought = false) const;

  std::deque<Refused> refused_;
};

}  // namespace armloom
