#include "core/planning/tree_search.h"

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <mutex>
#include <random>
#include <utility>

namespace armloom {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::RealVectorStateSpace;

Eigen::VectorXd joints_of(const ob::State* state, unsigned size) {
  return Eigen::Map<const Eigen::VectorXd>(state->as<Space::StateType>()->values, size);
}

void set(ob::State* state, const Eigen::VectorXd& q) {
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    state->as<Space::StateType>()->values[j] = q[j];
  }
}

// Draws samples from a seed, because OMPL's process-wide random source is not repeatable.
class SeededSampler final : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, const JointRoom& room, std::uint64_t seed)
      : ob::StateSampler(space), room_(room), random_(seed) {}

  void sampleUniform(ob::State* state) override {
    Eigen::VectorXd q(room_.lower.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const double share = static_cast<double>(random_() >> 11) * 0x1p-53;
      q[j] = room_.lower[j] + share * (room_.upper[j] - room_.lower[j]);
    }
    set(state, q);
  }
  // RRT-Connect does not call these two functions.
  void sampleUniformNear(ob::State* state, const ob::State*, double) override {
    sampleUniform(state);
  }
  void sampleGaussian(ob::State* state, const ob::State*, double) override { sampleUniform(state); }

 private:
  const JointRoom& room_;
  std::mt19937_64 random_;
};

class ProvenLines final : public ob::MotionValidator {
 public:
  ProvenLines(const ob::SpaceInformationPtr& si, const TreeSearch& search)
      : ob::MotionValidator(si), search_(search), size_(si->getStateDimension()) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return search_.is_free(joints_of(from, size_), joints_of(to, size_));
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    return checkMotion(from, to);
  }

 private:
  const TreeSearch& search_;
  unsigned size_;
};

void be_silent() {
  static std::once_flag once;
  std::call_once(once, [] { ompl::msg::noOutputHandler(); });
}

std::shared_ptr<ob::SpaceInformation> space_for(const TreeSearch& search) {
  const auto size = static_cast<unsigned>(search.start.size());
  auto space = std::make_shared<Space>(size);
  ob::RealVectorBounds bounds(size);
  for (unsigned j = 0; j < size; ++j) {
    bounds.setLow(j, search.room.lower[j]);
    bounds.setHigh(j, search.room.upper[j]);
  }
  space->setBounds(bounds);
  space->setStateSamplerAllocator([&search](const ob::StateSpace* of) {
    return std::make_shared<SeededSampler>(of, search.room, search.seed);
  });
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([](const ob::State*) { return true; });  // edges are checked
  information->setMotionValidator(std::make_shared<ProvenLines>(information, search));
  information->setup();
  return information;
}

}  // namespace

std::optional<std::vector<Eigen::VectorXd>> grow_trees(const TreeSearch& search) {
  be_silent();
  const auto information = space_for(search);
  const unsigned size = information->getStateDimension();
  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<> state(information);
  set(state.get(), search.start);
  problem->addStartState(state);
  auto goals = std::make_shared<ob::GoalStates>(information);
  for (const Eigen::VectorXd& goal : search.goals) {
    set(state.get(), goal);
    goals->addState(state);
  }
  problem->setGoal(goals);

  og::RRTConnect planner(information);
  planner.setRange(search.step);
  planner.setProblemDefinition(problem);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setup();
  const ob::PlannerTerminationCondition stop([&search] { return search.stop(); });
  if (planner.solve(stop) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;

  const auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
  std::vector<Eigen::VectorXd> points;
  for (std::size_t i = 0; i < path->getStateCount(); ++i) {
    points.push_back(joints_of(path->getState(static_cast<unsigned>(i)), size));
  }
  return points;
}

}  // namespace armloom
