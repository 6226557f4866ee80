// A small part of the fault campaign (README.md).
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "test/faults/fault_run.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

const std::vector<std::string> kPolicies{"coordinated", "earliest_start", "certified",
                                         "reservation", "lockstep",       "sequential"};

const ListedFault& listed(const std::string& name) {
  const auto& faults = listed_faults();
  const auto found = std::ranges::find(faults, name, &ListedFault::name);
  if (found == faults.end()) throw std::runtime_error("no fault \"" + name + "\"");
  return *found;
}

TEST(ListedFaults, AreDocumentedWithTheirOutcome) {
  std::ifstream file(source_dir() + "/test/faults/README.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(table_of_faults()), std::string::npos)
      << "replace the table by the output of build/fault_campaign --list";
  EXPECT_GE(listed_faults().size(), 40U);
  std::set<ArmFault::Kind> kinds;
  for (const ListedFault& fault : listed_faults()) {
    for (const FaultRequest& request : fault.faults) kinds.insert(request.kind);
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(ArmFault::Kind::clock_drift) + 1);
}

TEST(FaultRun, HasNoContactAndNoSilentJobUnderAnyListedFault) {
  std::uint64_t seed = 1000;
  for (const ListedFault& fault : listed_faults()) {
    const FaultRunPlan plan{
        .seed = ++seed, .policy = kPolicies[seed % kPolicies.size()], .fault = &fault};
    SCOPED_TRACE(fault.name + ", " + plan.policy + ", seed " + std::to_string(plan.seed));
    const FaultRunResult result = run_with_faults(plan);
    EXPECT_FALSE(result.contact) << to_seconds(result.contact->time) << " s";
    EXPECT_GT(result.jobs, 5U);
    EXPECT_TRUE(result.silent.empty()) << result.silent.front();
    EXPECT_GT(result.closest_m, 0.0);
  }
}

TEST(FaultRun, HasContactsOnlyIfTheMonitorIsOff) {
  const auto contacts = [](const char* name, bool monitored, std::vector<std::uint64_t> seeds) {
    return std::ranges::count_if(seeds, [&](std::uint64_t seed) {
      return run_with_faults({.seed = seed, .fault = &listed(name), .monitored = monitored})
          .contact.has_value();
    });
  };
  for (const bool monitored : {false, true}) {
    const auto drifts = contacts("drift 1 rad/s", monitored, {23, 24, 31, 33, 61, 64});
    const auto runaways = contacts("runaway", monitored, {138, 174, 192});
    EXPECT_EQ(drifts > 0, !monitored) << drifts;
    EXPECT_EQ(runaways > 0, !monitored) << runaways;
  }
}

// Long runs in which jobs waited forever. A job that any of several arms may take was the first of
// its arm. It had no plan, because it waited for the plan on another arm, or because many such jobs
// were ahead of it; and these waited for the jobs behind it.
//
// 14011: an arm drifted off its path in front of a motion that had authority to pass there. The
// guard refused this authority, but the scheduler counted on it, and let no other motion go first.
//
// 18114: an arm stood exactly start_tolerance_rad from the start of its next job. One comparison
// found it there, another one did not, and the job was checked again and again.
TEST(LongRun, NoJobWaitsAtTheEnd) {
  for (const auto& [seed, policy] : {std::pair(6071U, "sequential"),
                                     {6088U, "lockstep"},
                                     {14011U, "earliest_start"},
                                     {18114U, "coordinated"}}) {
    const FaultRunResult result = run_with_faults(
        {.seed = seed, .policy = policy, .jobs_for = std::chrono::minutes(30), .open_max = 40});
    EXPECT_GT(result.jobs, 1000U) << seed;
    EXPECT_EQ(result.waiting, 0U) << seed;
  }
}

// Jobs with steps under random faults, or none (odd seeds).
TEST(LongRun, LosesNoPartAndEndsAllJobsWithSteps) {
  std::size_t succeeded = 0, jobs = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    const std::vector<std::string> policies{"coordinated", "earliest_start", "certified",
                                            "reservation", "lockstep",       "sequential"};
    const FaultRunResult result = run_with_faults({.seed = seed,
                                                   .policy = policies[seed % policies.size()],
                                                   .faulty = seed % 2 == 0,
                                                   .tasks = true,
                                                   .jobs_for = std::chrono::minutes(6),
                                                   .open_max = 40});
    EXPECT_TRUE(result.lost.empty()) << seed;
    EXPECT_TRUE(!result.contact || result.may_touch) << seed;
    EXPECT_EQ(result.waiting, 0U) << seed;
    EXPECT_TRUE(result.silent.empty()) << seed << ": " << result.silent.front();
    jobs += result.jobs, succeeded += result.succeeded;
  }
  EXPECT_GT(jobs, 2000U);
  EXPECT_GT(succeeded, 500U);
}

TEST(FaultRun, StopsNoArmForNoiseAndLagWithinThePromises) {
  const FaultRunResult result = run_with_faults({.seed = 7,
                                                 .policy = "earliest_start",
                                                 .faulty = false,
                                                 .jobs_for = std::chrono::minutes(2)});
  EXPECT_EQ(result.stops.size(), 0U);
  EXPECT_FALSE(result.contact);
  EXPECT_GT(result.succeeded, 20U);
}

TEST(FaultRun, RepeatsForASeed) {
  for (const bool tasks : {false, true}) {
    FaultRunPlan plan{
        .seed = 3, .policy = "certified", .fault = &listed("loss 0.5"), .tasks = tasks};
    const std::uint64_t once = run_with_faults(plan).fingerprint;
    EXPECT_EQ(run_with_faults(plan).fingerprint, once);
    plan.seed = 4;
    EXPECT_NE(run_with_faults(plan).fingerprint, once);
  }
}

}  // namespace
}  // namespace armloom
