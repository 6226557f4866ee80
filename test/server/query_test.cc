#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/api/audit_query.h"
#include "server/api/query_format.h"

namespace armloom {
namespace {

struct Wanted {
  std::string name = "any";
  std::string of;
  std::size_t most = 10;
  std::optional<int> level;
  std::optional<std::uint64_t> before;
  bool whole = true;
};

QueryFormat<Wanted> wanted(ProblemKind bad = ProblemKind::invalid) {
  return QueryFormat<Wanted>(
      {query::text<Wanted>("name", &Wanted::name, "What it is called"),
       query::required_text("of", &Wanted::of, "Whose"),
       query::whole_number<Wanted>("most", &Wanted::most, 1, 100, "So many"),
       query::whole_number<Wanted>("level", &Wanted::level, -2, 2, "How"),
       query::cursor<Wanted>(&Wanted::before), query::flag("whole", &Wanted::whole, "0: in part")},
      bad);
}

Target target(std::initializer_list<std::pair<const std::string, std::string>> query) {
  Target target;
  target.path = "/things";
  for (const auto& [name, value] : query) target.query.emplace(name, value);
  return target;
}

TEST(QueryFormat, ReadsAllParameters) {
  const auto read = wanted().read(target({{"of", "me"},
                                          {"name", ""},
                                          {"most", "100"},
                                          {"level", "-2"},
                                          {"cursor", "18446744073709551615"},
                                          {"whole", "0"}}));
  ASSERT_TRUE(read) << read.error().front().detail;
  EXPECT_EQ(read->of, "me");
  EXPECT_EQ(read->name, "");
  EXPECT_EQ(read->most, 100U);
  EXPECT_EQ(read->level, -2);
  EXPECT_EQ(read->before, ~std::uint64_t{0});
  EXPECT_FALSE(read->whole);
}

TEST(QueryFormat, KeepsDefaultsOfAbsentParameters) {
  const auto read = wanted().read(target({{"of", "me"}}));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "any");
  EXPECT_EQ(read->most, 10U);
  EXPECT_FALSE(read->level);
  EXPECT_FALSE(read->before);
  EXPECT_TRUE(read->whole);
}

TEST(QueryFormat, ReportsEachInvalidParameter) {
  const auto read = wanted().read(
      target({{"of", "me"}, {"most", "0"}, {"level", "3"}, {"cursor", "-1"}, {"whole", "yes"}}));
  ASSERT_FALSE(read);
  ASSERT_EQ(read.error().size(), 4U);
  const char* const pointers[] = {"?most", "?level", "?cursor", "?whole"};
  const char* const values[] = {"0", "3", "-1", "yes"};
  for (std::size_t i = 0; i < 4; ++i) {
    const Problem& problem = read.error()[i];
    EXPECT_EQ(problem.pointer, pointers[i]);
    EXPECT_EQ(problem.slug, "bad-parameter");
    EXPECT_EQ(problem.kind, ProblemKind::invalid);
    EXPECT_EQ(std::get<std::string>(problem.value), values[i]);
    EXPECT_NE(problem.detail.find(values[i]), std::string::npos) << problem.detail;
  }
  EXPECT_NE(read.error()[0].detail.find("1..100"), std::string::npos);
}

TEST(QueryFormat, RefusesTextAroundNumbers) {
  for (const char* number :
       {"", " 1", "1 ", "+1", "1.0", "0x1", "1e1", "101", "99999999999999999999999"}) {
    EXPECT_FALSE(wanted().read(target({{"of", "me"}, {"most", number}}))) << number;
  }
}

TEST(QueryFormat, RequiresMandatoryParameters) {
  for (const auto& asked : {target({}), target({{"of", ""}})}) {
    const auto read = wanted().read(asked);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().slug, "missing-parameter");
    EXPECT_EQ(read.error().front().kind, ProblemKind::malformed);
    EXPECT_EQ(read.error().front().pointer, "?of");
  }
  const auto bad = wanted(ProblemKind::malformed).read(target({{"of", "me"}, {"whole", "2"}}));
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().front().kind, ProblemKind::malformed);
}

TEST(QueryFormat, DocumentsItsParameters) {
  const auto told = wanted().parameters();
  ASSERT_EQ(told.size(), 6U);
  EXPECT_TRUE(told[1].required);
  EXPECT_FALSE(told[0].required);
  EXPECT_EQ(told[2].schema["maximum"], 100);
  EXPECT_EQ(told[3].schema["minimum"], -2);
  EXPECT_EQ(told[5].schema["enum"], Schema::array({"0", "1"}));
}

TEST(AuditQuery, ReadsRfc3339Times) {
  const auto read = audit_query().read(target(
      {{"since", "1970-01-01T00:00:01Z"}, {"before", "1970-01-01T01:00:00+01:00"}, {"who", ""}}));
  ASSERT_TRUE(read) << read.error().front().detail;
  EXPECT_EQ(read->since_ms, 1000);
  EXPECT_EQ(read->before_ms, 0);
  EXPECT_EQ(read->who, "");
  for (const char* time : {"yesterday", "1970-01-01", "1970-01-01T00:00:01", "0"}) {
    EXPECT_FALSE(audit_query().read(target({{"since", time}}))) << time;
  }
}

}  // namespace
}  // namespace armloom
