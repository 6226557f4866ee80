#pragma once

#include "core/collision/diagram/motion_store.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers one question by a certified method (guarantees: motion_checker.h). The question must have
// begun in the store (MotionStore::begin_question).
class CertifiedCheck {
 public:
  // Store and question must outlive the CertifiedCheck.
  CertifiedCheck(MotionStore& store, const Question& question);
  [[nodiscard]] Verdict swept();
  [[nodiscard]] Verdict coordinated();

 private:
  struct ArmMotion {       // one arm of a motion, or an arm at rest
    const Motion* motion;  // null if at rest
    MotionStore::Entry* entry;

    [[nodiscard]] double progress_s() const;
  };
  [[nodiscard]] std::vector<ArmMotion> arms_of(const Motion& motion);
  [[nodiscard]] std::vector<ArmMotion> all_arms();
  void certify_alone();
  void certify_swept(const std::vector<ArmMotion>& all, std::size_t candidates);
  void check_alone(const ArmMotion& own);
  void check_swept(const ArmMotion& own, const ArmMotion& other);
  void check_in_step(const ArmMotion& own, const ArmMotion& other);
  [[nodiscard]] OrientedDiagram parting_of(const OrientedDiagram& diagram,
                                           const ProgressBand& band) const;
  void ask(const OrientedDiagram& diagram, const ProgressBand& band, const ArmMotion& own,
           const ArmMotion* other);
  void report(const CoordinationDiagram::Answer& answer, const OrientedDiagram& diagram,
              const ArmMotion& own, const ArmMotion* other);

  MotionStore& store_;
  const Question& question_;
  TrackingErrors tracking_errors_;
  Verdict verdict_;
};

// Returns a budget of `cells` for each 10 s of the longest motion, but at least `cells`.
[[nodiscard]] std::uint64_t cell_budget(std::uint64_t cells, double longest_s);

// Answers a PassageQuestion: appends to `passages` and `passage_blocks` of the verdict. Adds the
// number of evaluated cells to `evaluations`.
void check_passage(MotionStore& store, const PassageQuestion& passage, Configuration rest,
                   const TrackingErrors& tracking_errors, Verdict& verdict);

}  // namespace armloom
