#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/executive/executive.h"
#include "core/model/cell_description.h"
#include "test/scenarios/random_faults.h"

namespace armloom {

enum class RandomWorld {
  sliders,  // two to four arms with one axis, which cross
  pandas,   // two Pandas
};
[[nodiscard]] CellDescription random_cell(RandomWorld world, Random& random);

// Random jobs with trajectories, goals, alternatives and moves to their start, for one arm or
// several.
class RandomJobs {
 public:
  struct Arm {
    std::string name;
    std::vector<std::string> joints;
    std::vector<double> home;
    double spread;  // of random positions around home (rad, m), each joint
  };
  // `random` outlives this object, and so does the cell's executive. `only_goals`: no
  // trajectories, which may begin a little off the place where the arm rests.
  RandomJobs(const Cell& cell, Random& random, std::function<Executive&()> executive,
             bool only_goals = false);

  [[nodiscard]] JobRequest any();
  // Call for each accepted job: later jobs begin where it may leave its arms.
  void accepted(const std::string& key, const JobRequest& request);
  // Returns the key of an active or recent job; empty if there is none.
  [[nodiscard]] std::string any_job();
  [[nodiscard]] const std::vector<Arm>& arms() const { return arms_; }
  // Returns a random place for the arm's joints.
  [[nodiscard]] std::vector<double> anywhere(const Arm& arm);

 private:
  [[nodiscard]] std::vector<double> predicted(std::size_t arm);
  [[nodiscard]] std::vector<std::size_t> some_arms(std::size_t most);
  [[nodiscard]] JobRequest motion(const std::vector<std::size_t>& arms);
  [[nodiscard]] JobRequest loop();
  [[nodiscard]] JobRequest goal();

  Random& random_;
  std::function<Executive&()> executive_;
  bool only_goals_;
  std::vector<Arm> arms_;
  std::map<std::string, std::vector<std::vector<double>>>
      ends_;  // by key and arm: where the job may leave the arm; empty if the job does not move it
  std::uint64_t next_ = 1;
};

}  // namespace armloom
