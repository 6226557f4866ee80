#include <gtest/gtest.h>

#include <iostream>
#include <memory>

#include "core/collision/check/motion_checker.h"
#include "core/coordination/effort.h"
#include "test/bench/cells.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {
namespace {

// Two Pandas with 1 mm clearance and no tracking error (see also open_pairs_test.cc).
TEST(ClosePasses, AreDecidedWithARaisedBudget) {
  Cell cell = *bench::two_pandas();
  cell.clearances.clearance_m = 0.001;
  const auto shared = std::make_shared<const Cell>(std::move(cell));
  bench::ExactScene exact(shared);
  const Pool pool(exact, 64, 77);
  std::size_t open = 0;
  std::size_t left = 0;
  for (const MovingPair& pair : random_pairs(exact, pool, 3000, 78)) {
    MotionChecker checker(exact.scene);
    Question question = pair.question(*shared, Swept{.tracking_errors = 0.0});
    Verdict verdict = checker.judge(question);
    if (verdict.kind == Verdict::Kind::undecided) ++open;
    while (verdict.kind == Verdict::Kind::undecided) {
      const auto effort = larger_effort(verdict, question.effort);
      if (!effort) break;
      question.effort = *effort;
      verdict = checker.judge(question);
    }
    left += verdict.kind == Verdict::Kind::undecided ? 1 : 0;
  }
  std::cout << open << " open at first\n";
  EXPECT_GE(open, 3U);
  EXPECT_EQ(left, 0U);
}

}  // namespace
}  // namespace armloom::soundness
