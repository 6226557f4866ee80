#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/holding.h"
#include "core/executive/task_request.h"
#include "core/model/cell.h"

namespace armloom {

// Returns the JSON pointer "/steps/2".
[[nodiscard]] std::string place_of_step(std::size_t i);

// The objects of the cell when a task is submitted.
struct PresentObjects {
  std::vector<std::string> names;
  HandsOf hands;                                 // after all tasks before this one
  std::map<std::string, double> masses_kg = {};  // by name, if not zero
};

// Returns the objects of the scene, and what hands hold now.
[[nodiscard]] PresentObjects present_objects(const PlanningScene& scene);

// Adds what is wrong with the actions of a task, with pointers "/steps/2/attach/link":
// - "unknown-object", "unknown-link", "link-not-of-arm", "unknown-io", "wrong-type"
// - "not-held": an object is detached, or shared, that no arm holds at that step
// - "held-twice": an object is attached to a hand that holds it already
// - "no-motion-after": an arm that holds the object of an attach or detach has no later motion
// - "moves-alone": a motion of one of several arms that hold an object together
// - "ends-with-wait": the last step waits
// - "no-motion": no step moves an arm
void find_bad_steps(const Cell& cell, const std::vector<StepRequest>& steps,
                    const PresentObjects& present, Problems& problems);

// Returns why these steps, which have been found good before, do not fit what the arms hold now;
// nullopt if they do.
[[nodiscard]] std::optional<std::string> find_misfit(const Cell& cell,
                                                     const std::vector<StepRequest>& steps,
                                                     const PresentObjects& present);

}  // namespace armloom
