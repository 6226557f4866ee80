#include <map>
#include <sstream>

#include "core/policies/policy.h"
#include "test/server/command_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kCell;
using test::Outcome;

constexpr std::size_t kMachineColumns = 2;  // the last columns: times of the machine

std::vector<std::string> split(const std::string& line, char at) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, at);) {
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

// Returns the cells of a Markdown table without the line below its heading; fails the test if the
// text is not a table.
std::vector<std::vector<std::string>> table_of(const std::string& markdown) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(markdown);
  std::string line;
  for (int number = 0; std::getline(lines, line); ++number) {
    EXPECT_TRUE(line.starts_with("| ") && line.ends_with(" |")) << line;
    if (number == 1) {
      EXPECT_EQ(line.find_first_not_of("|-: "), line.npos) << line;
      continue;
    }
    std::vector<std::string> cells = split(line, '|');
    cells.erase(cells.begin());  // the part before the first bar
    rows.push_back(std::move(cells));
    EXPECT_EQ(rows.back().size(), rows.front().size()) << line;
  }
  return rows;
}

class Compare : public test::CommandFixture {
 protected:
  std::string compare(const fs::path& jobs) const {
    return "compare --cell " + kCell + " --jobs " + jobs.string();
  }
  // Returns the numbers of a column by policy; `heading` is the beginning of the column's heading.
  static std::map<std::string, double> column(const std::vector<std::vector<std::string>>& table,
                                              const std::string& heading) {
    std::size_t at = 0;
    while (at < table[0].size() && !table[0][at].starts_with(heading)) ++at;
    EXPECT_LT(at, table[0].size()) << heading;
    std::map<std::string, double> figures;
    for (std::size_t row = 1; row < table.size(); ++row) {
      figures[table[row][0]] = std::stod(table[row].at(at));
    }
    return figures;
  }
};

TEST_F(Compare, PrintsEveryPolicyWithPlausibleMakespans) {
  const Outcome outcome = run(compare(test::kSource / "config/two_pandas_jobs.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto table = table_of(outcome.out);
  const std::vector<std::string> names = policy_names();
  ASSERT_EQ(table.size(), 1 + names.size()) << outcome.out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(table[i + 1][0], names[i]);
    EXPECT_EQ(table[i + 1][1], "24 of 24");
    EXPECT_EQ(table[i + 1][2], "-");
  }
  auto makespan_s = column(table, "makespan");
  const char* order[] = {"earliest_start", "certified", "reservation", "sequential"};
  for (std::size_t i = 0; i + 1 < std::size(order); ++i) {
    EXPECT_LE(makespan_s.at(order[i]), 1.02 * makespan_s.at(order[i + 1])) << order[i];
  }
  EXPECT_LT(makespan_s.at("earliest_start"), 0.8 * makespan_s.at("sequential"));

  auto least = column(table, "busiest arm's work");
  auto together = column(table, "two or more arms move");
  auto left = column(table, "left moves");
  auto right = column(table, "right moves");
  for (const std::string& policy : names) {
    EXPECT_GT(least[policy], 0.0) << policy;
    EXPECT_LE(least[policy], 100.0) << policy << ": a bound is none that can be undercut";
    // An arm that brakes on its path and starts again moves for longer than its work alone takes.
    EXPECT_GE(least[policy], 0.9 * std::max(left[policy], right[policy])) << policy;
    // Both arms move within the same makespan, which bounds their common time from both sides. 0.2
    // and 0.1 allow for rounding.
    EXPECT_GE(together[policy], left[policy] + right[policy] - 100.2) << policy;
    EXPECT_LE(together[policy], std::min(left[policy], right[policy]) + 0.1) << policy;
  }
  EXPECT_EQ(together.at("sequential"), 0.0);
  EXPECT_GT(together.at("earliest_start"), 10.0);
  EXPECT_EQ(column(table, "monitor stops").at("certified"), 0.0);
}

TEST_F(Compare, RepeatsForASeedExceptMachineTimes) {
  const std::string command = compare(conflicting_jobs()) + " --seed 7";
  auto first = table_of(run(command).out);
  auto second = table_of(run(command).out);
  ASSERT_EQ(first.size(), 1 + policy_names().size());
  for (auto* table : {&first, &second}) {
    for (auto& row : *table) row.resize(row.size() - kMachineColumns);
  }
  EXPECT_EQ(first, second);
}

TEST_F(Compare, RunsTheGivenPoliciesInOrder) {
  const Outcome outcome = run(compare(conflicting_jobs()) + " --policies certified,sequential");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto table = table_of(outcome.out);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[1][0], "certified");
  EXPECT_EQ(table[2][0], "sequential");
  EXPECT_NEAR(column(table, "makespan").at("sequential"), 12.0, 0.3);  // four jobs of 3 s
  // Each arm has two jobs of 3 s.
  EXPECT_NE(outcome.out.find("busiest arm's work (left, 6.00 s)"), outcome.out.npos);
  EXPECT_NEAR(column(table, "busiest arm's work").at("sequential"), 50.0, 1.5);
}

TEST_F(Compare, WritesTheSameNumbersAsCsvAndSvg) {
  const fs::path out = folder_ / "a/b";
  const Outcome outcome =
      run(compare(conflicting_jobs()) + " --policies sequential,certified --out " + out.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(read_text_file(out / "compare.csv").value());
  std::vector<std::vector<std::string>> csv;
  for (std::string line; std::getline(lines, line);) csv.push_back(split(line, ','));
  ASSERT_EQ(csv.size(), 3U);
  for (const auto& row : csv) EXPECT_EQ(row.size(), csv[0].size());
  auto in_table = column(table_of(outcome.out), "makespan");
  auto in_csv = column(csv, "makespan_s");
  for (const auto& [policy, makespan_s] : in_table) {
    EXPECT_NEAR(in_csv.at(policy), makespan_s, 0.0051) << policy;
  }
  EXPECT_EQ(column(csv, "succeeded").at("certified"), 4.0);
  EXPECT_EQ(column(csv, "unfinished").at("certified"), 0.0);

  // Bar lengths are proportional to the makespans.
  const std::string parse =
      "python3 -c \"import sys, xml.etree.ElementTree as e; "
      "print(*[r.get('width') for r in e.parse(sys.argv[1]).iter() if "
      "r.tag.endswith('}rect')][1:])\" ";
  const std::string widths = (folder_ / "widths").string();
  ASSERT_EQ(std::system((parse + (out / "compare.svg").string() + " >" + widths).c_str()), 0);
  std::istringstream bars(read_text_file(widths).value());
  double sequential = 0.0, certified = 0.0;
  ASSERT_TRUE(bars >> sequential >> certified);
  EXPECT_GT(sequential, 100.0);
  EXPECT_NEAR(certified / sequential, in_csv.at("certified") / in_csv.at("sequential"), 1e-3);
}

TEST_F(Compare, EscapesTheCellNameInTheSvg) {
  const fs::path cell = changed_cell("/name", "two & <three> \"arms\" | \x01\xc3\xa9");
  const fs::path out = folder_ / "out-dir";
  const Outcome outcome =
      run("compare --cell " + cell.string() + " --jobs " + conflicting_jobs().string() +
          " --policies certified --out " + out.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string parse =
      "python3 -c \"import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])\" ";
  EXPECT_EQ(std::system((parse + (out / "compare.svg").string()).c_str()), 0)
      << read_text_file(out / "compare.svg").value();
}

TEST_F(Compare, ReportsJobsThatDoNotSucceed) {
  json jobs = json::parse(read_text_file(conflicting_jobs()).value());
  jobs[2]["job"]["backlog_timeout_s"] = 0.5;                     // shorter than the wait
  json astray = test::move("left", test::kMiddle, test::kHome);  // the arm will be at home
  jobs.push_back({{"at", 0.5}, {"job", astray}});
  const Outcome outcome =
      run(compare(file("some.json", jobs.dump())) + " --policies certified,sequential");
  EXPECT_EQ(outcome.exit_code, 1) << "a refused job has no end";
  const auto table = table_of(outcome.out);
  ASSERT_EQ(table.size(), 3U) << outcome.out;
  EXPECT_EQ(table[1][1], "2 of 5") << outcome.out;
  EXPECT_EQ(table[1][2], "1 expired, 1 failed, 1 refused") << outcome.out;
  EXPECT_EQ(table[2][2], "1 refused") << outcome.out;
  EXPECT_NE(outcome.err.find("certified: job j2 expired"), outcome.err.npos) << outcome.err;
  EXPECT_NE(outcome.err.find("some.json:/4/job/trajectory/points/0"), outcome.err.npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("(under sequential)"), outcome.err.npos) << outcome.err;

  jobs.erase(4);
  const Outcome ended = run(compare(file("some.json", jobs.dump())) + " --policies certified");
  EXPECT_EQ(ended.exit_code, 0) << "every job has an end, whatever it is";
  EXPECT_EQ(table_of(ended.out)[1][2], "1 expired, 1 failed");
}

TEST_F(Compare, ReportsBadInputBeforeAnythingRuns) {
  json bad = test::move("left", test::kHome, test::kMiddle);
  bad["trajectory"]["joint_names"][0] = "left_panda_joint9";
  const std::string bad_jobs =
      file("bad.json", json::array({{{"at", 0}, {"job", bad}}}).dump()).string();
  const std::string good = compare(conflicting_jobs());
  const fs::path taken = file("taken", "a file where a folder should be");
  const struct {
    std::string arguments;
    std::string says;
  } cases[] = {
      {"compare --cell " + kCell, "--jobs is required"},
      {compare(bad_jobs), "bad.json:/0/job/trajectory/joint_names/0"},
      {compare(folder_ / "nothing.json"), "nothing.json"},
      {compare(file("cut.json", "[{")), "cut.json:/0"},
      {"compare --cell " + (folder_ / "no.json").string() + " --jobs " + bad_jobs, "no.json"},
      {good + " --policies certified,hopeful", "--policies: unknown policy \"hopeful\""},
      {good + " --policies certified,", "--policies: unknown policy \"\""},
      {good + " --policies certified,sequential,certified",
       "armloom: --policies: policy \"certified\" is listed twice: remove one\n"},
      {good + " --seed -1", "--seed: -1 is not an integer"},
      {good + " --out " + taken.string(),
       "armloom: --out: the folder " + taken.string() + " cannot be written\n"},
  };
  for (const auto& wrong : cases) {
    const Outcome outcome = run(wrong.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << wrong.arguments;
    EXPECT_EQ(outcome.out, "") << wrong.arguments;
    EXPECT_NE(outcome.err.find(wrong.says), outcome.err.npos) << wrong.arguments << '\n'
                                                              << outcome.err;
  }
}

}  // namespace
}  // namespace armloom
