#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/executive/executive.h"
#include "core/model/cell_description.h"
#include "test/scenarios/random_jobs.h"

namespace armloom {

// Random jobs with steps: each arm has a part, which it picks, carries, places and hands over, also
// with both hands at the part for a while. All parts but the first are heavy. The steps also wait,
// set outputs and wait for an input.
class RandomTasks {
 public:
  // Adds what the tasks use: signals, and what the arms can carry.
  static void equip(CellDescription& cell);
  // `random` and `jobs` outlive this object, and so does the cell's executive.
  RandomTasks(const Cell& cell, Random& random, RandomJobs& jobs,
              std::function<Executive&()> executive);

  // Puts a part beside a random place of each arm's hand. Call after the first tick.
  void place_parts();
  // Returns nullopt if the chosen arm has no part to carry.
  [[nodiscard]] std::optional<JobRequest> any();
  // Call at intervals: sets the input to a random value.
  void set_input();
  // As an operator does while no arm moves: puts all parts back to where they were first, out of
  // the hands too, where that is possible now.
  void tidy_up();
  // Call with each scene that is published. Returns the parts that are not at exactly one place.
  [[nodiscard]] std::vector<std::string> see(const SceneView& scene);

 private:
  struct Grasp {
    std::size_t arm;        // whose hand let go of the part
    std::vector<double> q;  // joints of the arm then
  };
  using Steps = std::vector<StepRequest>;
  [[nodiscard]] std::vector<double> joints_of(std::size_t arm, const Configuration& q) const;
  [[nodiscard]] Eigen::Isometry3d hand_at(std::size_t arm, const std::vector<double>& q) const;
  [[nodiscard]] StepRequest move(std::size_t arm, std::vector<double> q) const;
  [[nodiscard]] StepRequest move_anywhere(std::size_t arm);
  [[nodiscard]] StepRequest attach(const std::string& part, std::size_t arm) const;
  [[nodiscard]] bool is_at_part(const std::string& part, const Eigen::Isometry3d& X_WO) const;
  void add_pause(Steps& steps);
  void place(Steps& steps, const std::string& part, std::size_t arm);
  void pick(Steps& steps, const std::string& part, std::size_t arm);
  [[nodiscard]] bool hand_over(Steps& steps, const std::string& part, std::size_t from,
                               std::size_t to);
  void carry_together(Steps& steps, std::size_t from, double qa, std::size_t to, double qb);
  void let_one_go(Steps& steps, const std::string& part, std::size_t first, std::size_t second);

  const Cell& cell_;
  Random& random_;
  RandomJobs& jobs_;
  std::function<Executive&()> executive_;
  std::vector<std::string> hands_;  // names of links, by arm
  std::set<std::string> parts_;
  struct Start {
    CollisionObject object;
    Grasp grasp;
  };
  std::map<std::string, Start> starts_;
  std::map<std::string, Grasp> grasps_;                // parts of the scene
  std::map<std::string, std::size_t> held_;            // parts: arms that carry them
  std::map<std::string, std::size_t> shared_with_;     // parts: other arms that hold them
  std::map<std::string, Eigen::Isometry3d> X_W_part_;  // parts of the scene
  std::uint64_t next_ = 1;
};

}  // namespace armloom
