#pragma once

#include <utility>
#include <vector>

#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"
#include "test/scheduler/stretches.h"

namespace armloom {

// Two one-joint arms are too close while both are within these intervals (rad); `a` and `b` differ.
struct Crossing {
  ArmId a;
  double from_a, to_a;
  ArmId b;
  double from_b, to_b;
};

struct Object {
  ArmId arm;
  double from, to;
};

// The geometry of one-joint arms as a table. Answers questions by the rules of core/collision;
// boxes are a microsecond too large. Motions must be straight lines (bench_cell.h).
class Crossings {
 public:
  explicit Crossings(std::vector<Crossing> table = {}) : table_(std::move(table)) {}
  void put(std::vector<Object> objects) { objects_ = std::move(objects); }

  [[nodiscard]] Verdict answer(const Question& question) const;

  // Returns true if the arms may be too close within these stretches. Intervals that only touch are
  // free.
  [[nodiscard]] bool meet(ArmId a, Stretch of_a, ArmId b, Stretch of_b) const;
  // Returns true if the motion is free of all objects and of other arms at `rest`.
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
