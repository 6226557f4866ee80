#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "core/executive/plan_task.h"

namespace armloom {

// Ways that were looked for in vain, so that nobody looks for them again while nothing that they
// were to pass has changed: the scene, where their arm sets out and is to go, and where the arms
// stand that were not left out. Whatever the seed.
class RefusedPlans {
 public:
  // What is known already of the question, written into the task.
  void tell(PlanTask& task);
  // The answer to a question that was asked in this scene, and not given up.
  void learn(const PlanQuestion& question, const PlanningScenePtr& scene, const PlanAnswer& answer);

  inline static constexpr std::size_t kMax = 64;  // of these the oldest are forgotten

 private:
  struct Refused {
    MotionGoal goal;
    Configuration at;
    std::vector<ArmId> left_out;
    PlanRefusal why;
  };
  void look_at(const PlanningScenePtr& scene);
  void add(const PlanQuestion& question, std::vector<ArmId> left_out, const PlanRefusal& why);
  [[nodiscard]] const PlanRefusal* find(const PlanQuestion& question,
                                        const std::vector<ArmId>& left_out,
                                        bool (*counts)(const PlanRefusal&) = nullptr) const;

  PlanningScenePtr scene_;
  std::deque<Refused> refused_;
};

}  // namespace armloom
