// plan_table CELL [SCENARIO]... [--jobs FILE]
// Makes the table of core/planning/README.md: plans between all named or published poses of each
// arm, other arms at home. Arms with few poses get random poses too. A scenario
// (shared/data/scenarios) adds its poses to the arms at its robots' places. FILE gets all solved
// queries as jobs for `armloom simulate` and `armloom audit` (plan_and_audit.py).
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "core/collision/check/line_checker.h"
#include "core/model/cell/build_cell.h"
#include "core/planning/plan_motion.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/cell_codec.h"
#include "test/bench/plan_rounds.h"

namespace armloom {
namespace {

using Poses = std::map<std::string, Eigen::VectorXd>;

double thread_time_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

CellPtr load(const std::string& file) {
  Problems problems;
  const auto folder = std::filesystem::path(file).parent_path();
  auto cell = build_cell(read_cell_text(text_of(file), folder, problems), problems);
  if (!cell) throw std::runtime_error(file + ": " + cell.error().front().detail);
  return *cell;
}

void add_published(const nlohmann::json& scenario, const Cell& cell, std::vector<Poses>& poses) {
  for (const auto& [name, base] : scenario["bases"].items()) {
    for (std::size_t a = 0; a < cell.arms.size(); ++a) {
      const Eigen::Vector3d p = cell.robots[cell.arms[a].robot.index()].X_WB.translation();
      const auto xyz = base["xyz"].get<std::vector<double>>();
      if ((p - Eigen::Vector3d(xyz[0], xyz[1], xyz[2])).norm() > 0.01) continue;
      for (const auto& [pose, robots] : scenario["poses"].items()) {
        if (!robots.contains(name)) continue;
        const auto q = robots[name].get<std::vector<double>>();
        if (q.size() != cell.arms[a].joints.size()) continue;
        poses[a][pose] =
            Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
      }
    }
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Row {
  std::size_t queries = 0, parted = 0, straight = 0, in_time = 0, stopping = 0;
  std::vector<double> ms, stretch;
  std::vector<std::string> colliding, unsolved;
  PlanRounds rounds;
};

// Adds ten free poses with a fixed seed.
void add_postures(const Cell& cell, ArmId id, LineChecker& lines, Poses& free) {
  if (free.size() > 4) return;
  std::mt19937_64 random(1);
  const Arm& arm = cell.arm(id);
  for (int made = 0; made < 10;) {
    Eigen::VectorXd q = arm.home;
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      const Joint& joint = cell.joint(arm.joints[j]);
      q[static_cast<Eigen::Index>(j)] = std::uniform_real_distribution(
          std::max(joint.lower, -2.9), std::min(joint.upper, 2.9))(random);
    }
    if (!lines.is_free(q, q)) continue;
    static const Eigen::IOFormat kOneLine(3, 0, ", ", ", ", "", "", "[", "]");
    std::ostringstream name;
    name << "posture " << ++made << " " << q.transpose().format(kOneLine);
    free.emplace(name.str(), q);
  }
}

// Returns the poses that are free with other arms at home; records the other poses' conflicts.
Poses free_poses(const PlanningScenePtr& scene, ArmId id, const Poses& poses, Row& row) {
  const Cell& cell = scene->cell();
  LineChecker lines(scene, id, cell.home(), cell.checking.tracking_error_rad);
  Poses free;
  for (const auto& [name, q] : poses) {
    const auto answer = lines.state(q);
    if (answer.kind == LineChecker::Kind::free) {
      const auto same = [&q](const auto& other) { return (other.second - q).norm() < 1e-9; };
      if (std::ranges::none_of(free, same)) free.emplace(name, q);
    } else {
      row.colliding.push_back(name + ": " + in_words(*answer.proximity, answer.moves_m));
    }
  }
  add_postures(cell, id, lines, free);
  return free;
}

class Queries {
 public:
  Queries(const PlanningScenePtr& scene, ArmId id, const Poses& free, Row& row)
      : planner_(scene),
        id_(id),
        poses_(free.begin(), free.end()),
        groups_(free.size()),
        row_(row) {}

  void run() {
    for (std::size_t from = 0; from < poses_.size(); ++from) {
      for (std::size_t to = 0; to < poses_.size(); ++to) {
        if (from == to) continue;
        if (groups_.are_parted(from, to)) {
          ++row_.parted;
        } else {
          ask(from, to);
        }
      }
    }
  }

 private:
  [[nodiscard]] PlanRequest request(std::size_t from, std::size_t to) const {
    const Cell& cell = planner_.scene()->cell();
    PlanRequest request{.arm = id_, .at = cell.home(), .goals = {poses_[to].second}};
    set_joints(request.at, cell.arm(id_).joints, poses_[from].second);
    return request;
  }

  void ask(std::size_t from, std::size_t to) {
    const double begin_ms = thread_time_ms();
    const auto planned = plan_motion(planner_, request(from, to));
    const double ms = thread_time_ms() - begin_ms;
    if (!planned && part(from, to)) return;
    ++row_.queries;
    row_.ms.push_back(ms);
    if (!planned) {
      row_.unsolved.push_back(poses_[from].first + " to " + poses_[to].first + ": " +
                              planned.error().detail);
      return;
    }
    groups_.join(from, to);
    row_.in_time += ms <= 1000.0;
    row_.straight += planned->way.points.size() == 2;
    row_.stopping += planned->way.points.size() > 2 && planned->rounded_within == 0.0;
    row_.stretch.push_back(planned->way.length() /
                           (poses_[to].second - poses_[from].second).norm());
    row_.rounds.add(from, to, planned->timed.request);
  }

  // Returns true if even ten times the budget finds no path.
  bool part(std::size_t from, std::size_t to) {
    if (groups_.are_joined(from, to)) return false;
    PlanRequest longer = request(from, to);
    longer.budget *= 10;
    if (planner_.plan(longer)) return groups_.join(from, to), false;
    groups_.part(from, to);
    row_.unsolved.push_back("very likely no way: " + poses_[from].first + " to " +
                            poses_[to].first);
    ++row_.parted;
    return true;
  }

  Planner planner_;
  ArmId id_;
  std::vector<std::pair<std::string, Eigen::VectorXd>> poses_;
  PoseGroups groups_;
  Row& row_;
};

void print(const std::string& name, const Row& row) {
  std::printf(
      "| %s | %zu | %zu | %.1f %% | %zu | %zu | %.2f | %.1f | %.0f | %.2f | %.2f | %.2f |\n",
      name.c_str(), row.queries, row.parted,
      100.0 * static_cast<double>(row.in_time) / static_cast<double>(row.queries), row.straight,
      row.stopping, quantile(row.ms, 0.5), quantile(row.ms, 0.95), quantile(row.ms, 1.0),
      quantile(row.stretch, 0.5), quantile(row.stretch, 0.95), quantile(row.stretch, 1.0));
  std::fflush(stdout);
}

std::size_t home_of(const Poses& free, const Eigen::VectorXd& home) {
  const auto is_home = [&](const auto& pose) { return (pose.second - home).norm() < 1e-9; };
  const auto found = std::ranges::find_if(free, is_home);
  if (found == free.end()) throw std::runtime_error("an arm may not stand at home");
  return static_cast<std::size_t>(std::distance(free.begin(), found));
}

int table(std::vector<std::string> files) {
  std::string jobs_file;
  if (files.size() > 2 && files[files.size() - 2] == "--jobs") {
    jobs_file = files.back();
    files.resize(files.size() - 2);
  }

  const CellPtr cell = load(files.front());
  const auto scene = PlanningScene::build(cell);
  if (!scene) throw std::runtime_error(scene.error().front().detail);
  std::vector<Poses> poses;
  for (const Arm& arm : cell->arms) {
    poses.push_back({{"home (cell)", arm.home}});
    for (const auto& [name, q] : arm.named_states) poses.back()[name] = q;
  }
  for (std::size_t i = 1; i < files.size(); ++i) {
    add_published(nlohmann::json::parse(text_of(files[i])), *cell, poses);
  }
  std::puts(
      "| cell, arm | queries | no path | solved in 1 s | straight | stops | ms: median | p95 | "
      "most | "
      "length: median | p95 | most |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  std::string notes;
  std::deque<Row> rows;
  std::vector<std::vector<const TrajectoryRequest*>> rounds;
  for (std::uint32_t a = 0; a < cell->arms.size(); ++a) {
    Row& row = rows.emplace_back();
    const Poses free = free_poses(*scene, ArmId{a}, poses[a], row);
    Queries(*scene, ArmId{a}, free, row).run();
    rounds.push_back(row.rounds.round_from(home_of(free, cell->arms[a].home)));
    print(cell->name + " " + cell->arms[a].name, row);
    for (const auto& pose : row.colliding) notes += cell->arms[a].name + " " + pose + "\n";
    for (const auto& pair : row.unsolved) notes += "unsolved: " + pair + "\n";
  }
  std::cout << notes;
  if (!jobs_file.empty()) write_jobs(jobs_file, rounds);
  return 0;
}

}  // namespace
}  // namespace armloom

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "plan_table CELL [SCENARIO]... [--jobs FILE]\n";
    return 2;
  }
  try {
    return armloom::table({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "plan_table: " << error.what() << '\n';
    return 2;
  }
}
