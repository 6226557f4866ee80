#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/executive/holding.h"
#include "core/executive/task.h"

namespace armloom {

// Keeps what ended steps allowed to touch until the arms have left the object: otherwise they could
// not move away.
class LeftTouch {
 public:
  // Changes what the present steps of a task allow to touch; keeps what they no longer allow.
  // `arms`: of the task. Returns the objects with a change.
  std::set<std::string> change(TouchOf& present, const TouchOf& next,
                               const std::vector<ArmId>& arms);
  // Returns the objects that these arms may not have left.
  [[nodiscard]] std::vector<std::string> of(const std::vector<ArmId>& arms) const;
  // Returns what the object may touch while the present steps allow `now`. Forgets the ended steps
  // if their arms can move from where they are without them. `at`: positions of all joints.
  [[nodiscard]] Touch allowed(const PlanningScenePtr& scene, const Configuration& at,
                              const std::string& object, Touch now);

 private:
  struct Left {
    Touch touch;
    std::set<ArmId> arms;
  };
  std::map<std::string, Left> left_;  // by object
};

// A scene in which the steps of a task allow objects to touch.
struct TouchScene {
  PlanningScenePtr scene;
  LeftTouch left = {};
  // From now on, the step allows `next`. `present`: what it allowed before. `arms`: of the task.
  void change(TouchOf& present, const TouchOf& next, const std::vector<ArmId>& arms,
              const Configuration& at);
  // Does an action: `attach` and `detach` change the scene, others do not. Problems: those of
  // attached() and detached().
  [[nodiscard]] Result<void> act(const StepRequest& step, TouchOf& present,
                                 const std::vector<ArmId>& arms, const Configuration& at);
  // These arms have moved.
  void moved(const std::vector<ArmId>& arms, const TouchOf& present, const Configuration& at);

 private:
  void show(const std::string& object, const TouchOf& present, const Configuration& at);
};

}  // namespace armloom
