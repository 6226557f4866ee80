// Pandas with the stock jobs, late, slow and stalling at random: the recorded motion is audited
// with plain FCL, which shares nothing with the admission. ARMLOOM_SEEDS=500 runs 500 of each cell.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/audit/audit.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/messages/job_request.h"
#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kSeeds = 3;
constexpr Duration kRecorded = 5ms;  // between recorded states
constexpr Duration kAudited = 2ms;   // step of the audit

std::string text_of(const std::string& name) {
  std::ifstream file(source_dir() + "/config/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Recorder final : Observer {
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override {
    if (!states.empty() && now < states.back().time + kRecorded) return;
    states.push_back({now, measured});
  }
  std::vector<RecordedState> states;
};

// The stock jobs in pairs: out, and home again.
struct Stock {
  CellPtr cell;
  std::map<std::string, std::vector<std::pair<JobRequest, JobRequest>>> loops;  // by first joint
};

Stock stock(const std::string& name) {
  CellDescription description = *read_cell_text(text_of(name + ".json"), source_dir() + "/config");
  description.scheduling.backlog_timeout = 300s;
  Stock read{*build_cell(description), {}};
  std::map<std::string, std::vector<JobRequest>> chains;
  auto jobs = *read_jobs_text(text_of(name + "_jobs.json"));
  for (TimedJob& timed : jobs) {
    chains[timed.job.trajectory.joint_names.front()].push_back(std::move(timed.job));
  }
  for (const auto& [joint, chain] : chains) {
    for (std::size_t i = 0; i + 1 < chain.size(); i += 2) {
      read.loops[joint].push_back({chain[i], chain[i + 1]});
    }
  }
  return read;
}

struct PandasRun : DelayedRun {
  AuditReport audited;
};

// Of each arm two to four random pairs; arms take turns in submitting, at once or with pauses.
PandasRun run(const Stock& stock, std::uint64_t seed, const std::string& policy) {
  Random random(seed);
  Recorder recorder;
  auto created = Simulation::create(stock.cell, ExecutiveOptions{.policy = policy}, recorder);
  Simulation& simulation = **created;
  Executive& executive = simulation.executive();
  simulation.tick();
  for (const Arm& arm : stock.cell->arms) delay_at_random(executive, arm.name, 15.0, random);
  const bool paused = random.chance(0.5);
  const std::size_t rounds = 2 + random.index(3);
  std::vector<std::string> keys;
  const auto submit = [&](JobRequest job) {
    job.key.clear();
    const auto view = executive.submit(std::move(job));
    EXPECT_TRUE(view);
    if (view) keys.push_back(view->key);
    if (paused) simulation.run_until(simulation.now() + from_seconds(random.uniform(0.0, 1.0)));
  };
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<const JobRequest*> back;
    for (const auto& [joint, loops] : stock.loops) {
      const auto& [out, home] = loops[random.index(loops.size())];
      submit(out);
      back.push_back(&home);
    }
    for (const JobRequest* home : back) submit(*home);
  }
  while (!executive.all_ended() && simulation.now() < at(600s)) simulation.tick();
  if (std::getenv("ARMLOOM_TOLD") != nullptr) {
    for (const std::string& key : keys) {
      const JobView job = *executive.job(key);
      std::cout << seed << " " << job.name << " submitted " << to_seconds(job.times.submitted_at)
                << " began " << (job.times.started_at ? to_seconds(*job.times.started_at) : -1.0)
                << " " << told(job) << "\n";
    }
  }
  PandasRun outcome;
  outcome.read(executive, keys);
  outcome.audited = *audit(*stock.cell, recorder.states, kAudited);
  return outcome;
}

struct Case {
  const char* cell;
  const char* policy;

  [[nodiscard]] std::string name() const { return std::string(cell) + "_" + policy; }
  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name(); }
};
class PandaDelays : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cells, PandaDelays,
                         ::testing::Values(Case{"two_pandas", "earliest_start"},
                                           Case{"two_pandas", "coordinated"},
                                           Case{"four_pandas", "earliest_start"},
                                           Case{"four_pandas", "coordinated"}),
                         [](const auto& one) { return one.param.name(); });

TEST_P(PandaDelays, AuditFindsNoContactAndEveryJobSucceeds) {
  const Stock pandas = stock(GetParam().cell);
  double smallest_m = 1e9;
  std::uint64_t stops = 0, jobs = 0;
  for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
    const PandasRun outcome = run(pandas, seed, GetParam().policy);
    const auto& contact = outcome.audited.first_contact;
    EXPECT_FALSE(contact) << "seed " << seed << ": " << contact->body_a << " and "
                          << contact->body_b << " at " << to_seconds(contact->time) << " s";
    EXPECT_TRUE(outcome.all_ended) << "seed " << seed << ": jobs hang";
    EXPECT_EQ(outcome.succeeded, outcome.jobs) << "seed " << seed << ": " << outcome.first_other;
    if (outcome.audited.smallest_clearance) {
      smallest_m = std::min(smallest_m, outcome.audited.smallest_clearance->distance_m);
    }
    stops += outcome.monitor_stops;
    jobs += outcome.jobs;
  }
  std::cout << GetParam().cell << ", " << GetParam().policy << ": " << seed_count(kSeeds)
            << " seeds, " << jobs << " jobs, closest " << smallest_m << " m, " << stops
            << " monitor stops\n";
}

}  // namespace
}  // namespace armloom
