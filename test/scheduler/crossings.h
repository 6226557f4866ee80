#pragma once

#include <utility>
#include <vector>

#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"
#include "test/scheduler/stretches.h"

namespace armloom {

// Two arms of one joint each are too close while `a` is between these places and `b` between those
// (rad). No two of the same arm.
struct Crossing {
  ArmId a;
  double from_a, to_a;
  ArmId b;
  double from_b, to_b;
};

// An object in the way of an arm.
struct Object {
  ArmId arm;
  double from, to;
};

// The geometry of a cell of one-joint arms as a table, and its answers to questions of every
// method, by the rules of core/collision: exact, but for boxes that are a microsecond too large.
// Motions go straight from place to place (`move` and `visit` of bench_cell.h).
class Crossings {
 public:
  explicit Crossings(std::vector<Crossing> table = {}) : table_(std::move(table)) {}
  void put(std::vector<Object> objects) { objects_ = std::move(objects); }

  [[nodiscard]] Verdict answer(const Question& question) const;

  // Whether the two may be too close while each is somewhere on its stretch; edges are free.
  [[nodiscard]] bool meet(ArmId a, Stretch of_a, ArmId b, Stretch of_b) const;
  // Whether the motion finds its way when every other arm stands there; with all objects.
  [[nodiscard]] bool free_beside(const Trajectory& motion, const Configuration& rest) const;

 private:
  struct Standing {
    ArmId arm;
    double q;
  };
  struct Box : ProgressBox {
    ArmId a, b;
  };
  [[nodiscard]] std::vector<Box> boxes(const Motion& a, const Motion& b) const;
  [[nodiscard]] std::vector<Box> boxes(const Motion& a, Standing b) const;
  [[nodiscard]] static std::vector<ConflictRegion> regions_of(std::vector<Box> boxes);
  [[nodiscard]] bool meets_object(const Motion& motion) const;
  [[nodiscard]] bool meets_itself(const Motion& motion) const;
  [[nodiscard]] std::vector<Standing> standing_beside(const Question& question,
                                                      const Motion& candidate) const;
  [[nodiscard]] PassageAnswer answer(const PassageQuestion& passage) const;
  void coordinate(const Question& question, Verdict& verdict) const;
  void compare_sweeps(const Question& question, Verdict& verdict) const;
  void compare_instants(const Question& question, Duration step, Verdict& verdict) const;

  std::vector<Crossing> table_;
  std::vector<Object> objects_;
};

}  // namespace armloom
