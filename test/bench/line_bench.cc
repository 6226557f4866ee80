// line_bench [EDGES]
// Checks edges of a planner: one arm moves straight through its joint space while the others rest.
// Compares LineChecker, which certifies the whole edge, with FCL the MoveIt way at states 0.01 rad
// apart (contact only). Prints the times, and the colliding edges that the samples miss.
#include <algorithm>
#include <chrono>
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

double us_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
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

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  using namespace armloom::bench;
  const std::size_t edges = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 600;
  std::printf(
      "| cell | edges | free | proven: us, median | p95 | of free ones: median | p95 | FCL "
      "sampled: "
      "us, median | of free ones | times | undecided | contacts that samples pass | below the "
      "clearance |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  run("two Pandas", two_pandas(), edges);
  run("four Pandas", circle_of_pandas(4, 0.55), edges);
  return 0;
}
