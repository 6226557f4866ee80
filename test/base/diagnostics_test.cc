#include "core/base/diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

Problem problem(const std::string& pointer, const std::string& detail = "is wrong") {
  return {ProblemKind::invalid, "wrong", pointer, detail, {}};
}
auto at(const std::string& pointer) { return Field(&Problem::pointer, pointer); }

TEST(Diagnostics, KeepTheOrderInWhichTheyWereAdded) {
  Diagnostics found;
  found.add(problem("/b"));
  found.warn(problem("/w"));
  found.add(problem("/a"));
  EXPECT_THAT(found.take(), ElementsAre(at("/b"), at("/a")));
  EXPECT_THAT(found.take_warnings(), ElementsAre(at("/w")));
}

TEST(Diagnostics, StartEmpty) {
  Diagnostics found;
  EXPECT_THAT(found.take(), IsEmpty());
  EXPECT_THAT(found.take_warnings(), IsEmpty());
}

// Two robots may share one URDF file.
TEST(Diagnostics, CountDuplicatesButReportEachOnce) {
  Diagnostics found;
  found.add(problem("/a"));
  found.add(problem("/a"));
  found.add(problem("/a", "is wrong in another way"));
  EXPECT_EQ(found.count(), 3U);
  EXPECT_EQ(found.take().size(), 2U);
}

TEST(Diagnostics, KeepAHundredAndCountTheRest) {
  Diagnostics found;
  for (int i = 0; i < 107; ++i) found.add(problem("/" + std::to_string(i)));
  for (int i = 0; i < 101; ++i) found.warn(problem("/" + std::to_string(i)));
  const Problems problems = found.take();
  ASSERT_EQ(problems.size(), Diagnostics::kMaxDiagnostics + 1);
  EXPECT_EQ(problems[99].pointer, "/99");
  EXPECT_EQ(problems.back().detail, "and 7 more problems of the cell");
  EXPECT_EQ(found.take_warnings().back().detail, "and 1 more warnings of the cell");
}

// Otherwise many warnings of one kind could displace a hazard.
TEST(Diagnostics, KeepAHundredOfEachSlug) {
  Diagnostics found;
  for (int i = 0; i < 107; ++i) found.warn(problem("/" + std::to_string(i)));
  found.warn({ProblemKind::invalid, "no-collision", "/links", "are not checked", {}});
  const Problems warnings = found.take_warnings();
  ASSERT_EQ(warnings.size(), Diagnostics::kMaxDiagnostics + 2);
  EXPECT_EQ(warnings[100].slug, "no-collision");
  EXPECT_EQ(warnings.back().detail, "and 7 more warnings of the cell");
}

TEST(Diagnostics, MergeUnchangedOrAllAsWarnings) {
  const auto part = [] {
    Diagnostics of;
    of.add(problem("/problem"));
    of.warn(problem("/warning"));
    return of;
  };
  Diagnostics used;
  used.merge(part());
  EXPECT_EQ(used.count(), 1U);
  EXPECT_THAT(used.take(), ElementsAre(at("/problem")));
  EXPECT_THAT(used.take_warnings(), ElementsAre(at("/warning")));

  Diagnostics unused;
  unused.merge_as_warnings(part());
  EXPECT_EQ(unused.count(), 0U);
  EXPECT_THAT(unused.take(), IsEmpty());
  EXPECT_THAT(unused.take_warnings(), ElementsAre(at("/problem"), at("/warning")));
}

TEST(Diagnostics, InCellCarryPointerAndValue) {
  Diagnostics found;
  found.in_cell("out-of-range", "/clearance_m", "clearance_m is negative", -0.1);
  const Problems problems = found.take();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].kind, ProblemKind::invalid);
  EXPECT_EQ(problems[0].slug, "out-of-range");
  EXPECT_EQ(std::get<double>(problems[0].value), -0.1);
}

TEST(Numbers, FormatAsShortestRoundTripText) {
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(3.0), "3");
  EXPECT_EQ(text_of(1e300), "1e+300");
  for (const double number : {0.1 + 0.2, 1.0 / 3.0, 2.1750000000000003}) {
    EXPECT_EQ(std::stod(text_of(number)), number);
  }
}

// RFC 6901: tildes are escaped first. Otherwise the tilde of an escaped slash would be escaped
// again.
TEST(PointerTokens, EscapeTildesAndSlashes) {
  EXPECT_EQ(pointer_token("a/b"), "a~1b");
  EXPECT_EQ(pointer_token("~1"), "~01");
  EXPECT_EQ(pointer_token("plain"), "plain");
}

}  // namespace
}  // namespace armloom
