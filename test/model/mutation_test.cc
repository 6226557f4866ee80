#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "core/model/kinematics.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// Returns the text with bytes replaced, or with pieces dropped, duplicated or replaced.
std::string mutated(std::string text, std::mt19937& random) {
  static const char* const kTokens[] = {"nan", "-",      "1e308", "<",         ">",     "/>",
                                        "\"",  "&#0;",   "&amp;", "<!--",      "joint", "link",
                                        "-0",  "9e-300", "mimic", "<![CDATA[", "\xff",  " "};
  const auto below = [&](std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
  };
  for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(below(60) + 1, text.size() - at);
    switch (below(4)) {
      case 0:
        text[at] = static_cast<char>(below(255) + 1);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      default:
        text.replace(at, std::min<std::size_t>(length, 4), kTokens[below(std::size(kTokens))]);
    }
  }
  return text;
}

void expect_cell_or_problems(const CellDescription& description, const std::string& text,
                             int& built) {
  const auto cell = build_cell(description);
  if (!cell) {
    ASSERT_FALSE(cell.error().empty());
    for (const auto& problem : cell.error()) {
      EXPECT_FALSE(problem.pointer.empty() || problem.detail.empty()) << text;
      EXPECT_NE(problem.slug, "urdf-refused")
          << problem.detail << text;  // our own check must report this first
    }
    return;
  }
  ++built;
  LinkPoses X_WL;
  forward_kinematics(**cell, (*cell)->home(), X_WL);
  for (const auto& X : X_WL) {
    EXPECT_FALSE(std::isnan(X.matrix().sum())) << text;
    EXPECT_NEAR(X.linear().determinant(), 1.0, 1e-9) << text;
  }
}

TEST(MutatedFiles, UrdfGivesACellOrProblemsButNoNaN) {
  const ScratchFolder folder;
  const std::string original = text_of_file(data_file("two_arms.urdf"));
  CellDescription description = two_arms_description();
  std::mt19937 random(20);
  int built = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::string text = mutated(original, random);
    description.robots[0].urdf = folder.write("twin.urdf", text);
    ASSERT_NO_FATAL_FAILURE(expect_cell_or_problems(description, text, built));
  }
  EXPECT_GT(built, 50);    // edits of comments and numbers leave a valid robot
  EXPECT_LT(built, 1500);  // and most other edits do not
}

TEST(MutatedFiles, SrdfGivesACellOrProblems) {
  const ScratchFolder folder;
  const std::string original = text_of_file(data_file("two_arms.srdf"));
  CellDescription description = two_arms_description();
  std::mt19937 random(21);
  int built = 0;
  for (int round = 0; round < 1000; ++round) {
    const std::string text = mutated(original, random);
    description.robots[0].srdf = folder.write("twin.srdf", text);
    ASSERT_NO_FATAL_FAILURE(expect_cell_or_problems(description, text, built));
  }
  EXPECT_GT(built, 25);
  EXPECT_LT(built, 750);
}

}  // namespace
}  // namespace armloom
