#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "core/base/nearest_name.h"
#include "core/base/plain_name.h"

namespace armloom {
namespace {

constexpr std::array<std::string_view, 4> kKnown{"panda_joint1", "panda_joint2", "elbow", "lift"};

TEST(NearestName, HasTheSmallestEditDistance) {
  EXPECT_EQ(nearest_name("elbwo", kKnown), "elbow") << "neighbours swapped";
  EXPECT_EQ(nearest_name("ellbow", kKnown), "elbow") << "one too many";
  EXPECT_EQ(nearest_name("elbo", kKnown), "elbow") << "one left out";
  EXPECT_EQ(nearest_name("panda_joint_2", kKnown), "panda_joint2");
  EXPECT_EQ(nearest_name("panda_joint9", kKnown), "panda_joint1") << "of two, the first";
}

TEST(NearestName, IsNulloptIfMoreThanAThirdDiffers) {
  EXPECT_EQ(nearest_name("elba", kKnown), std::nullopt) << "two of five";
  EXPECT_EQ(nearest_name("wrist", kKnown), std::nullopt);
  EXPECT_EQ(nearest_name("", kKnown), std::nullopt);
  EXPECT_EQ(nearest_name("elbow", {}), std::nullopt);
}

// A client may send a very long name.
TEST(NearestName, IgnoresNamesLongerThanTheLimit) {
  const std::string long_name(101, 'a');
  const std::array<std::string_view, 1> same{long_name};
  EXPECT_EQ(nearest_name(long_name, same), std::nullopt);
}

TEST(DidYouMean, SuggestsTheNearestKeyOrNothing) {
  const std::map<std::string, int> known{{"elbow", 1}, {"wrist", 2}};
  EXPECT_EQ(did_you_mean("elbwo", known), "; did you mean elbow?");
  EXPECT_EQ(did_you_mean("gripper", known), "");
  std::map<std::string, int> many;
  for (int i = 0; i < 301; ++i) many["joint" + std::to_string(i)] = i;
  EXPECT_EQ(did_you_mean("joint_1", many), "") << "too many to look through each time";
}

TEST(PlainName, RejectsWhatIsNoPathSegment) {
  for (const char* name : {"left", "rod 1", "a.b", "...", "Ätzbad", "~"}) {
    EXPECT_TRUE(is_plain_name(name)) << name;
  }
  for (const char* name : {"", ".", "..", "a/b", "a\\b", "a\nb", "a\x7f"}) {
    EXPECT_FALSE(is_plain_name(name)) << name;
  }
}

TEST(PlainName, MeasuresLengthInCharacters) {
  std::string name;
  for (std::size_t i = 0; i < kPlainNameMax; ++i) name += "ä";
  EXPECT_EQ(characters(name), kPlainNameMax);
  EXPECT_TRUE(is_plain_name(name));
  EXPECT_FALSE(is_plain_name(name + "a"));
}

}  // namespace
}  // namespace armloom
