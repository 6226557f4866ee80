#include "core/jobs/invariants.h"

namespace armloom {
namespace {

using Broken = std::optional<std::string>;

std::string name(StepId step) { return "job " + std::to_string(step.job.value()); }

std::string at(Duration progress) { return std::to_string(to_seconds(progress)) + " s"; }

Broken of_job(const State& state, const Step& step) {
  if (step.has_ended()) return name(step.id) + " has ended but is in a queue";
  if (step.occupies_its_arms() && !state.jobs.queues().is_first(step)) {
    return name(step.id) + " occupies an arm, but another job precedes it in the queue";
  }
  if (!step.has_authority() || state.graph.holds(step.id)) return std::nullopt;
  return name(step.id) + " moves or is about to move, but is not admitted";
}

Broken of_motion(const State& state, const CoordinatedMotion& motion) {
  if (!state.jobs.active().contains(motion.step.job))
    return name(motion.step) + " has ended but is admitted";
  if (state.jobs.at(motion.step).in<Queued>() != nullptr) {
    return name(motion.step) + " waits in the queue but is admitted";
  }
  const bool in_order = Duration{} <= motion.progress && motion.progress <= motion.authority &&
                        motion.authority <= motion.duration;
  if (in_order) return of_job(state, state.jobs.at(motion.step));
  return name(motion.step) + ": progress " + at(motion.progress) + ", authority " +
         at(motion.authority) + ", duration " + at(motion.duration) + " are out of order";
}

Broken of_order(const State& state, const Precedence& order) {
  const CoordinatedMotion* first = state.graph.find(order.first());
  const CoordinatedMotion* second = state.graph.find(order.second());
  if (first == nullptr || second == nullptr) {
    return "an order of " + name(order.first()) + " and " + name(order.second()) +
           " refers to a motion that is no longer admitted";
  }
  for (const ProgressBox& box : order.region().boxes) {
    const bool meets = first->progress < box.to_a && box.from_a < first->authority &&
                       second->progress < box.to_b && box.from_b < second->authority;
    if (!meets) continue;
    return name(order.first()) + " may be at " + at(first->progress) + " to " +
           at(first->authority) + ", " + name(order.second()) + " at " + at(second->progress) +
           " to " + at(second->authority) + ", in their region from " + at(box.from_a) + " and " +
           at(box.from_b);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> broken_invariant(const State& state) {
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    if (auto broken = of_motion(state, motion)) return broken;
  }
  for (const Precedence& order : state.graph.precedences()) {
    if (auto broken = of_order(state, order)) return broken;
  }
  for (const Step& head : state.jobs.heads()) {
    if (auto broken = of_job(state, head)) return broken;
  }
  return std::nullopt;
}

}  // namespace armloom
