#include "server/codec/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/codec/json_writer.h"

namespace armloom {
namespace {

struct BadText {
  const char* name;
  std::string text;
  const char* slug;
  const char* pointer;
  const char* says;  // part of the detail
};

void PrintTo(const BadText& bad, std::ostream* out) { *out << bad.name; }

class BadJson : public ::testing::TestWithParam<BadText> {};

TEST_P(BadJson, IsRefusedWithPlaceAndReason) {
  const auto result = parse_json(GetParam().text, JsonComments::refused);
  ASSERT_FALSE(result);
  const Problem& problem = result.error().front();
  EXPECT_EQ(problem.slug, GetParam().slug);
  EXPECT_EQ(problem.pointer, GetParam().pointer);
  EXPECT_NE(problem.detail.find(GetParam().says), std::string::npos) << problem.detail;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadJson,
    ::testing::Values(
        BadText{"Empty", "", "malformed-json", "", "ends before"},
        BadText{"Cut", R"({"a": [1, 2)", "malformed-json", "/a/2", "ends before"},
        BadText{"Nan", R"({"points": [{"positions": [0, NaN]}]})", "malformed-json",
                "/points/0/positions/1", "line 1, column 31"},
        BadText{"Trailing", "{}\n{}", "malformed-json", "", "line 2, column 1"},
        BadText{"Huge", R"({"t": [0.5, 1e999]})", "malformed-json", "/t/1", "double"},
        BadText{"Twice", R"({"a": {"b": 1, "b": 2}})", "duplicate-key", "/a/b", "twice"},
        BadText{"Nul", std::string("{}\0{}", 5), "malformed-json", "", "NUL"},
        BadText{"Utf8", "{\"a\": \"\xff\"}", "malformed-json", "/a", "line 1"},
        BadText{"Comment", "{} // no", "malformed-json", "", "line 1"},
        BadText{"Deep", std::string(33, '[') + std::string(33, ']'), "nesting-too-deep",
                "/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0", "32"},
        BadText{"Escapes", R"({"a/b": {"c~d": tru}})", "malformed-json", "/a~1b/c~0d", "line 1"}),
    [](const auto& tested) { return tested.param.name; });

// RFC 8259: the cases of published suites, separated by two spaces or line ends.
constexpr const char* kGood =
    R"(0  -0  -1  1E22  1e+2  1E-2  0e1  0.5  123.456e78  -1.0e-2  1e-10000  true  false  null
""  []  {}  [ ]  [[] ]  [null,1,"1",{}]  {"":0}  {"a":[]}  {"a\u0000b":1}  "\u0060\u012a"
"\"\\\/\b\f\n\r\t"  "\uD801\udc37"  "\u0022\u005C"  "/* no */"  "€😀"  "<.>")";
constexpr const char* kBad =
    R"([1 true]  [a]  ["": 1]  [""],  [,1]  [1,,2]  ["x"]]  [1,]  [  [1  ["a  [,]  [-]  [3[4]]  [,""]
[*]  [nul]  [fals]  [tru]  [True]  [++1]  [+1]  [-01]  [-1.0.]  [-2.]  [.-1]  [.2e-3]  [0.1.2]  [0.3e+]
[0.3e]  [0.e1]  [0E]  [1.0e-]  [1 000.0]  [1eE2]  [2.e3]  [9.e+]  [Inf]  [NaN]  [Infinity]  [-Infinity]
[0x1]  [1+2]  [012]  [- 1]  [1a]  [１]  {"x", 1}  {"x"::1}  {[: "x"}  {"a" b}  {:"b"}  {"a"  {1:1}  {null:0}
{"a":1,}  {"a":1,,"b":2}  {'a':0}  {a: 1}  {"a":1} #  {"a":1}/**/  {}}  {"a":"b"}#{}  ["\uD800\u"]
["\u00A"]  ["\uQQQQ"]  ["\x00"]  ["\a"]  ["\"]  ["\  ["\uD800"]  ["\uDC00"]  ["\uD800\uD800"]  ['a']
[\n]  "  "x  x  1]  ]  <.>  [<null>]  TRUE  nan  [⁠])";

std::vector<std::string> cases_of(std::string text) {
  std::vector<std::string> cases;
  for (std::size_t at = 0; (at = text.find('\n')) != text.npos;) text.replace(at, 1, "  ");
  for (std::size_t at = 0, end = 0; end != text.npos; at = end + 2) {
    end = text.find("  ", at);
    cases.push_back(text.substr(at, end - at));
  }
  return cases;
}

TEST(JsonText, AcceptsAllTextsOfTheRfc) {
  auto cases = cases_of(kGood);
  EXPECT_EQ(cases.size(), 30U);
  for (const char* more : {"\t\r\n{\n}\n", "[1\n]", "\"\x7f\"", "\"\xef\xbf\xbf\xe2\x80\xa8\""}) {
    cases.emplace_back(more);
  }
  for (const std::string& good : cases) {
    EXPECT_TRUE(parse_json(good, JsonComments::refused)) << good;
  }
}

TEST(JsonText, RefusesAllTextsThatTheRfcForbids) {
  auto cases = cases_of(kBad);
  EXPECT_EQ(cases.size(), 85U);
  for (const char* more : {"", " ", "[\"\t\"]", "[\"\n\"]", "[\"\x1f\"]", "[\x0c]", "\xc2\xa0[]",
                           "\xff\xfe[]", "[\"\xe0\xff\"]", "[\"\xc0\xaf\"]", "[\"\xed\xa0\x80\"]",
                           "[\"\xf4\x90\x80\x80\"]", "[\"\xe2\x82\"]"}) {
    cases.emplace_back(more);
  }
  for (const std::string& bad : cases) {
    EXPECT_FALSE(parse_json(bad, JsonComments::refused)) << bad;
  }
}

TEST(JsonText, SurvivesAMillionBrackets) {
  EXPECT_FALSE(parse_json(std::string(1'000'000, '['), JsonComments::refused));
}

TEST(JsonText, AllowsCommentsOnRequest) {
  const auto result = parse_json("{ /* a */ \"b\": 1 // c\n}", JsonComments::allowed);
  ASSERT_TRUE(result);
  EXPECT_EQ((*result)["b"], 1);
}

TEST(JsonText, ReportsTheValueFound) {
  const auto result = parse_json(R"({"a": -Infinity})", JsonComments::refused);
  ASSERT_FALSE(result);
  EXPECT_EQ(std::get<std::string>(result.error().front().value), "-Infinity");
}

TEST(JsonWriter, WritesTextThatReadsBack) {
  JsonWriter out;
  out.begin_object().field("quote\"", "line\nbreak\x01 \xF0\x9F\xA6\xBE");
  out.field("bad", std::string_view("a\xffz")).field("nan", 0.0 / 0.0).field("third", 1.0 / 3.0);
  out.field("list", std::vector<double>{1.0, -0.5}).key("near").rounded(-1e-9, 6).end_object();
  const auto json = nlohmann::json::parse(out.text());
  EXPECT_EQ(json["quote\""], "line\nbreak\x01 \xF0\x9F\xA6\xBE");
  EXPECT_EQ(json["bad"], "a\xEF\xBF\xBDz");
  EXPECT_TRUE(json["nan"].is_null());
  EXPECT_EQ(json["third"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json["list"].size(), 2U);
  EXPECT_EQ(json["near"].dump(), "0");
}

TEST(JsonWriter, HasNoMinusZero) {
  JsonWriter out;
  out.begin_array().value(-0.0).value(std::vector<double>{-0.0, 0.0}).rounded(-0.0, 3);
  out.rounded(-1e-9, 6).value(-1e-9).end_array();
  EXPECT_EQ(out.text(), "[0,[0,0],0,0,-1e-09]");
}

}  // namespace
}  // namespace armloom
