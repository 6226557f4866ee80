// line_bench [EDGES [STATES]]
// Second table: checks of states and of lines of 0.5 rad of one arm among objects (STATES, random).
// Means of one call, by thread CPU time; each is the median of five rounds.
// First table: checks edges of a planner: one arm moves straight through its joint space while the
// others rest. Compares LineChecker, which certifies the whole edge, with FCL the MoveIt way at
// states 0.01 rad apart (contact only). Prints the times, and the colliding edges that the samples
// miss.
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include "core/collision/check/line_checker.h"
#include "core/collision/state/clearance_query.h"
#include "test/bench/cells.h"
#include "test/bench/moveit_way.h"
#include "test/bench/states.h"

namespace armloom::bench {
namespace {

constexpr double kSamples_rad = 0.01;  // largest joint step between two samples
constexpr double kFine_rad = 0.0005;   // the same for the reference
constexpr double kEdge = 1.2;          // Euclidean length, like a planner's edge

double thread_time_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

double us_of(const std::function<void()>& work) {
  const double begin_us = thread_time_us();
  work();
  return thread_time_us() - begin_us;
}

struct Edge {
  const Cell& cell;
  ArmId arm;
  Configuration rest;
  Eigen::VectorXd from, to;

  [[nodiscard]] Configuration at(double share) const {
    Configuration q = rest;
    for (std::size_t j = 0; j < cell.arm(arm).joints.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      q[static_cast<Eigen::Index>(cell.arm(arm).joints[j].index())] =
          from[row] + share * (to[row] - from[row]);
    }
    return q;
  }
  // Returns true if `bad` is true for any sampled state of the edge. Joints move at most step_rad
  // between two samples.
  [[nodiscard]] bool any(double step_rad, const std::function<bool(const Configuration&)>& bad,
                         int* first = nullptr) const {
    const int count =
        std::max(1, static_cast<int>(std::ceil((to - from).lpNorm<Eigen::Infinity>() / step_rad)));
    for (int i = 0; i <= count; ++i) {
      if (!bad(at(static_cast<double>(i) / count))) continue;
      if (first != nullptr) *first = i;
      return true;
    }
    return false;
  }
};

double quantile(std::vector<double> of, double share) {
  std::ranges::sort(of);
  return of[static_cast<std::size_t>(share * static_cast<double>(of.size() - 1))];
}

void run(const char* name, const CellPtr& cell, std::size_t edges) {
  Referees referees(cell);
  ExactScene& exact = referees.exact;
  MoveItWay& moveit = referees.moveit;
  ClearanceQuery query(exact.scene);
  std::mt19937_64 random(5);
  const auto states = free_states(referees, edges / 20 + 4);
  std::vector<double> proven_us, sampled_us, free_us, free_sampled_us;
  int free = 0, undecided = 0, contact_passed = 0, contacts = 0, close_passed = 0, close = 0;
  const ArmId arm{0};
  const auto& joints = cell->arm(arm).joints;
  for (std::size_t i = 0; i < edges; ++i) {
    Edge edge{*cell, arm, states[i % states.size()], {}, {}};
    edge.from.resize(static_cast<Eigen::Index>(joints.size()));
    edge.to = edge.from;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Joint& joint = cell->joint(joints[j]);
      const auto row = static_cast<Eigen::Index>(j);
      edge.from[row] = edge.rest[static_cast<Eigen::Index>(joints[j].index())];
      edge.to[row] = std::uniform_real_distribution(joint.lower, joint.upper)(random);
    }
    const double length = (edge.to - edge.from).norm();
    if (length > kEdge) edge.to = edge.from + kEdge / length * (edge.to - edge.from);
    LineChecker lines(exact.scene, arm, edge.rest, cell->checking.tracking_error_rad);
    if (lines.state(edge.from).kind != LineChecker::Kind::free) continue;
    bool is_free = false, sampled_free = false;
    proven_us.push_back(us_of([&] { is_free = lines.is_free(edge.from, edge.to); }));
    const auto touches = [&](const Configuration& q) { return moveit.in_collision(q); };
    sampled_us.push_back(us_of([&] { sampled_free = !edge.any(kSamples_rad, touches); }));
    if (is_free) {
      ++free;
      free_us.push_back(proven_us.back());
      if (sampled_free) free_sampled_us.push_back(sampled_us.back());
      continue;
    }
    undecided += lines.line(edge.from, edge.to).kind == LineChecker::Kind::undecided;
    const auto too_close = [&](const Configuration& q) {
      const Configuration* one = &q;
      return query.too_close({&one, 1}) != 0;
    };
    const auto in_contact = [&](const Configuration& q) { return exact.in_contact(q); };
    const bool is_close = edge.any(kFine_rad, too_close);
    close += is_close;
    close_passed += is_close && !edge.any(kSamples_rad, too_close);
    const bool touching = edge.any(kFine_rad, in_contact);
    contacts += touching;
    contact_passed += touching && !edge.any(kSamples_rad, in_contact);
  }
  std::printf(
      "| %s | %zu | %d | %.1f | %.1f | %.1f | %.1f | %.0f | %.0f | %.0f | %d | %d of %d | "
      "%d of %d |\n",
      name, proven_us.size(), free, quantile(proven_us, 0.5), quantile(proven_us, 0.95),
      quantile(free_us, 0.5), quantile(free_us, 0.95), quantile(sampled_us, 0.5),
      quantile(free_sampled_us, 0.5), quantile(free_sampled_us, 0.5) / quantile(free_us, 0.5),
      undecided, contact_passed, contacts, close_passed, close);
  std::fflush(stdout);
}

// ---- One arm among objects ----

// Returns the time of one call of visit(i), for i below `count`.
double mean_us(std::size_t count, const auto& visit) {
  std::array<double, 5> rounds{};
  for (double& round : rounds) {
    const double begin = thread_time_us();
    for (std::size_t i = 0; i < count; ++i) visit(i);
    round = (thread_time_us() - begin) / static_cast<double>(std::max<std::size_t>(count, 1));
  }
  std::ranges::sort(rounds);
  return rounds[2];
}

struct Line {
  Eigen::VectorXd from, to;
};

// Returns a random line of 0.5 rad that begins at q, cut at the joints' limits.
Line line_from(const Cell& cell, const Eigen::VectorXd& q, std::mt19937_64& random) {
  Eigen::VectorXd step(q.size());
  for (double& each : step) each = std::normal_distribution()(random);
  Line line{q, q + 0.5 / step.norm() * step};
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const Joint& joint = cell.joint(cell.arms[0].joints[static_cast<std::size_t>(j)]);
    line.to[j] = std::clamp(line.to[j], joint.lower, joint.upper);
  }
  return line;
}

// Returns true if the arm is too close in a state in which each joint is off the line by the
// tracking error, near the place `at` (a share of the line).
bool too_close_nearby(ClearanceQuery& query, const Cell& cell, const Line& line, double at) {
  const std::vector<JointId>& joints = cell.arms[0].joints;
  for (const double ahead : {0.0, -1e-3, 1e-3, -5e-3, 5e-3}) {
    const Eigen::VectorXd q = line.from + std::clamp(at + ahead, 0.0, 1.0) * (line.to - line.from);
    for (unsigned signs = 0; signs < 1U << joints.size(); ++signs) {
      Configuration off = cell.home();
      for (std::size_t j = 0; j < joints.size(); ++j) {
        const double error = cell.checking.tracking_error_rad;
        off[static_cast<Eigen::Index>(joints[j].index())] =
            q[static_cast<Eigen::Index>(j)] + ((signs >> j & 1U) != 0 ? error : -error);
      }
      const Configuration* one = &off;
      if (query.too_close({&one, 1}) != 0) return true;
    }
  }
  return false;
}

void run_among_objects(const char* name, const CellPtr& cell, std::size_t count) {
  const PlanningScenePtr scene = *PlanningScene::build(cell);
  ClearanceQuery query(scene);
  LineChecker checker(scene, ArmId{0}, cell->home(), cell->checking.tracking_error_rad);
  std::mt19937_64 random(54);
  std::vector<Configuration> clear, close;
  for (std::size_t i = 0; i < count; ++i) {
    Configuration q = cell->home();
    for (const JointId id : cell->arms[0].joints) {
      q[static_cast<Eigen::Index>(id.index())] =
          std::uniform_real_distribution(cell->joint(id).lower, cell->joint(id).upper)(random);
    }
    const Configuration* one = &q;
    (query.too_close({&one, 1}) == 0 ? clear : close).push_back(q);
  }
  std::vector<Line> free, refused;
  std::size_t undecided = 0, off_path = 0;  // off_path: too close within the tracking error
  for (std::size_t i = 0; i < count && !clear.empty(); ++i) {
    Eigen::VectorXd q(static_cast<Eigen::Index>(cell->arms[0].joints.size()));
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const JointId id = cell->arms[0].joints[static_cast<std::size_t>(j)];
      q[j] = clear[i % clear.size()][static_cast<Eigen::Index>(id.index())];
    }
    if (!checker.is_free(q, q)) continue;  // too close with the tracking error
    Line line = line_from(*cell, q, random);
    const auto [kind, at, proximity, moves_m] = checker.line(line.from, line.to);
    if (kind == LineChecker::Kind::undecided) {
      ++undecided;
      off_path += too_close_nearby(query, *cell, line, at) ? 1 : 0;
    }
    (kind == LineChecker::Kind::free ? free : refused).push_back(std::move(line));
  }
  const auto state = [&](const std::vector<Configuration>& of) {
    return mean_us(of.size(), [&](std::size_t i) {
      const Configuration* one = &of[i];
      (void)query.too_close({&one, 1});
    });
  };
  const double by_eights = mean_us(clear.size() / 8, [&](std::size_t i) {
    std::array<const Configuration*, 8> eight;
    for (std::size_t k = 0; k < 8; ++k) eight[k] = &clear[8 * i + k];
    (void)query.too_close(eight);
  });
  const auto lines = [&](const std::vector<Line>& of) {
    return mean_us(of.size(), [&](std::size_t i) { (void)checker.is_free(of[i].from, of[i].to); });
  };
  const double points = mean_us(
      free.size(), [&](std::size_t i) { (void)checker.is_free(free[i].from, free[i].from); });
  std::printf(
      "| %s | %zu of %zu | %.3f | %.2f | %.2f | %zu of %zu | %zu, %zu | %.2f | %.2f | %.2f |\n",
      name, clear.size(), count, by_eights / 8.0, state(clear), state(close), free.size(),
      free.size() + refused.size(), undecided, off_path, lines(free), points, lines(refused));
}

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  using namespace armloom::bench;
  const std::size_t edges = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 600;
  const std::size_t states = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 10'000;
  std::printf(
      "| cell | edges | free | proven, us: median | p95 | proven, of free ones: median | p95 | FCL "
      "sampled, us: median | FCL, of free ones: median | times | undecided | contacts that samples "
      "pass | below the clearance |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  run("two Pandas", two_pandas(), edges);
  run("four Pandas", circle_of_pandas(4, 0.55), edges);
  std::printf(
      "\n| one Panda among objects, us | clear states | clear state, by eights | one per call | "
      "too close, one per call | free lines | undecided, of these too close within the tracking "
      "error "
      "| free line | of length 0 | refused line |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  run_among_objects("contact", panda_among_objects(true), states);
  run_among_objects("20 mm", panda_among_objects(false), states);
  return 0;
}
