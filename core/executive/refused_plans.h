#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "core/executive/plan_task.h"

namespace armloom {

// Caches failed planning queries. A query is answered from the cache unless the scene, the start,
// the goal, or the position of an arm that the query had to avoid has changed. The seed is ignored.
class RefusedPlans {
 public:
  // Sets PlanTask::known if the answer is cached.
  void tell(PlanTask& task);
  // Stores the answer to a query in this scene if the planner found no path and was not canceled.
  void learn(const PlanQuestion& question, const PlanningScenePtr& scene, const PlanAnswer& answer);

  inline static constexpr std::size_t kMax = 64;  // the oldest are dropped

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
