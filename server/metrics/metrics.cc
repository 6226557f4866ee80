#include "server/metrics/metrics.h"

#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <atomic>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "core/executive/real_time_loop.h"
#include "server/metrics/period_watch.h"

namespace armloom {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;
using Buckets = Histogram::BucketBoundaries;

constexpr double kOverrunPeriods = 5.0;

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

const Buckets kPeriods{0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.5, 1.0};
const Buckets kReactions{0.00005, 0.0001, 0.0002, 0.0005, 0.001, 0.002,
                         0.005,   0.01,   0.02,   0.03,   0.05,  0.1};
const Buckets kLatencies{0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.5, 1.0, 5.0};

// Returns the label of one side of a pair. All objects share the label "scene", because clients may
// choose any number of object names.
std::string side(const std::optional<ArmId>& arm, const Cell& cell) {
  return arm ? cell.arms[arm->index()].name : "scene";
}

}  // namespace

class Metrics::Impl {
 public:
  Impl(CellPtr cell, double speed) : cell_(std::move(cell)) {
    set_speed(speed);
    // Creates the counters at zero, so that Prometheus computes rates from the first event on.
    for (const JobState state : kJobEnds) {
      jobs_.Add({{"outcome", to_string(state)}});
    }
    for (const Wait::Kind kind :
         {Wait::Kind::job, Wait::Kind::arm, Wait::Kind::object, Wait::Kind::predecessor,
          Wait::Kind::capacity, Wait::Kind::stop, Wait::Kind::plan, Wait::Kind::guard,
          Wait::Kind::speed, Wait::Kind::io, Wait::Kind::action, Wait::Kind::holding}) {
      waits_.Add({{"reason", to_string(kind)}});
    }
    for (const MonitorFinding::Kind kind : kValues<MonitorFinding::Kind>) {
      findings_.Add({{"kind", to_string(kind)}});
    }
    for (const char* what : {"requests", "jobs", "connections"}) limited_.Add({{"what", what}});
    for (const char* state : {"queued", "backlogged", "scheduled", "running"}) at(state);
    for (const SignalDescription& signal : cell_->io.signals) {  // none is connected yet
      if (signal.place) io_not_connected_.Add({{"device", signal.place->device}}).Increment();
    }
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void set_speed(double speed) { scale_ = std::max(1.0, 1.0 / speed); }

  void ticked() { control_.happened(scale_); }

  void watch_begins() {
    const auto now = Clock::now();
    if (watch_began_) {
      const double period = scale_ / cell_->monitor.rate_hz;
      const double gap = seconds(now - *watch_began_);
      late_.Observe(std::max(0.0, gap - period));
      // Up to a period and a half is jitter.
      if (gap >= 1.5 * period) missed_.Increment(std::round(gap / period) - 1.0);
    }
    watch_began_ = now;
  }

  void monitor_stopped(std::size_t arms) {
    arms_stopped_.Increment(static_cast<double>(arms));
    if (!watch_began_) return;
    const double took = seconds(Clock::now() - *watch_began_);
    reactions_.Observe(took);
    if (took > slowest_reaction_.Value()) slowest_reaction_.Set(took);
  }

  void watched(const StateFrame& frame) {
    monitor_.happened(scale_);
    for (const Proximity& near : frame.clearance) {
      Nearest& nearest = nearest_of(near);
      nearest.now->Set(near.clearance_m);
      if (near.clearance_m < nearest.smallest->Value()) nearest.smallest->Set(near.clearance_m);
    }
  }

  void judged(std::uint64_t evaluations) {
    evaluations_.Increment(static_cast<double>(evaluations));
  }

  void happened(const Event& event) {
    if (const auto* job = std::get_if<JobView>(&event.body)) follow(*job);
    if (const auto* found = std::get_if<MonitorEvent>(&event.body)) {
      findings_.Add({{"kind", to_string(found->finding.kind)}}).Increment();
    }
    if (std::holds_alternative<GuardEvent>(event.body)) guard_refusals_.Increment();
    if (const auto* signal = std::get_if<SignalView>(&event.body)) follow(*signal);
    if (const auto* queue = std::get_if<QueueView>(&event.body)) {
      const auto size = [](const std::vector<std::string>& keys) {
        return static_cast<double>(keys.size());
      };
      at("queued").Set(size(queue->queued));
      at("backlogged").Set(size(queue->backlog));
      at("scheduled").Set(size(queue->scheduled));
      at("running").Set(size(queue->running));
      stopped_.Set(queue->stopped ? 1 : 0);
    }
  }

  void answered(const std::string& method, const std::string& route, int status,
                std::chrono::nanoseconds after) {
    const std::string where = route.empty() ? "other" : route;
    // Clients may send any method. Only routes have a limited number of methods.
    const std::string how = route.empty() ? "any" : method;
    answers_.Add({{"method", how}, {"route", where}, {"status", std::to_string(status)}})
        .Increment();
    took_.Add({{"method", how}, {"route", where}}, kLatencies).Observe(seconds(after));
  }

  void limited(const char* what) { limited_.Add({{"what", what}}).Increment(); }

  void stop_taken(std::chrono::nanoseconds after) { stops_.Observe(seconds(after)); }
  void stored(std::chrono::nanoseconds within) { transactions_.Observe(seconds(within)); }

  std::string text(const Readings& readings) {
    readers_.Set(static_cast<double>(readings.readers));
    raise(frames_dropped_, readings.frames_dropped);
    raise(sent_away_, readings.subscribers_disconnected);
    recording_lost_.Set(readings.recording_lost ? 1 : 0);
    storage_failed_.Set(readings.storage_failed ? 1 : 0);
    return prometheus::TextSerializer().Serialize(registry_.Collect());
  }

 private:
  struct Nearest {
    Gauge* now;
    Gauge* smallest;
  };

  Family<Counter>& counters(const char* name, const char* help) {
    return prometheus::BuildCounter().Name(name).Help(help).Register(registry_);
  }
  Family<Gauge>& gauges(const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry_);
  }
  Family<Histogram>& histograms(const char* name, const char* help) {
    return prometheus::BuildHistogram().Name(name).Help(help).Register(registry_);
  }
  Gauge& at(const char* state) { return waiting_.Add({{"state", state}}); }
  static void raise(Counter& counter, std::uint64_t to) {
    const double by = static_cast<double>(to) - counter.Value();
    if (by > 0) counter.Increment(by);
  }

  PeriodWatch::Parts watch_parts(const char* loop) {
    const std::map<std::string, std::string> labels{{"loop", loop}};
    return {periods_.Add(labels, kPeriods), overruns_.Add(labels), worst_.Add(labels)};
  }

  // Returns the gauges of a pair, which are created at its first appearance. Call on the strand.
  // Pairs are few and permanent.
  Nearest& nearest_of(const Proximity& near) {
    std::pair<std::string, std::string> pair{side(near.arm_a, *cell_), side(near.arm_b, *cell_)};
    if (pair.second < pair.first) std::swap(pair.first, pair.second);
    const auto known = nearest_.find(pair);
    if (known != nearest_.end()) return known->second;
    const std::map<std::string, std::string> labels{{"a", pair.first}, {"b", pair.second}};
    Nearest nearest{&clearance_.Add(labels), &clearance_min_.Add(labels)};
    nearest.smallest->Set(near.clearance_m);
    return nearest_.emplace(std::move(pair), nearest).first->second;
  }

  // Counts the first decision, new kinds of waits and the end of a published job.
  void follow(const JobView& job) {
    const auto now = std::chrono::steady_clock::now();
    if (job.state == JobState::queued) {
      open_.try_emplace(job.key, Open{now, {}});
    }
    const auto found = open_.find(job.key);
    if (found == open_.end()) return;
    Open& open = found->second;
    if (job.state != JobState::queued && std::exchange(open.undecided, false)) {
      decisions_.Observe(seconds(now - open.since));
    }
    for (const WaitView& wait : job.waits_on) {
      if (open.reasons.insert(wait.kind).second) {
        waits_.Add({{"reason", to_string(wait.kind)}}).Increment();
      }
    }
    if (!is_terminal(job.state)) return;
    jobs_.Add({{"outcome", to_string(job.state)}}).Increment();
    open_.erase(found);
  }

  void follow(const SignalView& signal) {
    if (signal.device.empty()) return;
    bool& before = without_connection_.try_emplace(signal.name, true).first->second;
    const bool is_without = !signal.is_connected;
    if (std::exchange(before, is_without) == is_without) return;
    io_not_connected_.Add({{"device", signal.device}}).Increment(is_without ? 1 : -1);
  }

  struct Open {
    std::chrono::steady_clock::time_point since;
    std::set<Wait::Kind> reasons;
    bool undecided = true;
  };

  CellPtr cell_;
  std::atomic<double> scale_{1.0};
  prometheus::Registry registry_;
  Family<Counter>& jobs_ = counters("armloom_jobs_total", "Ended jobs, by outcome");
  Family<Gauge>& io_not_connected_ =
      gauges("armloom_io_signals_not_connected",
             "Signals without a connection to their device, or that their device refuses");
  std::map<std::string, bool> without_connection_;  // by signal; true if missing
  Family<Counter>& waits_ = counters("armloom_job_waits_total", "Jobs that waited, by reason");
  Family<Gauge>& waiting_ = gauges("armloom_jobs", "Jobs that have not ended, by state");
  Gauge& stopped_ = gauges("armloom_stopped", "1 if every arm is stopped").Add({});
  Histogram& decisions_ =
      histograms("armloom_decision_seconds", "Time from a job's arrival to its first decision")
          .Add({}, kLatencies);
  Counter& evaluations_ =
      counters("armloom_evaluations_total", "Collision evaluations for decisions").Add({});
  Family<Gauge>& clearance_ =
      gauges("armloom_clearance_metres", "Clearance of a pair, measured by the monitor");
  Family<Gauge>& clearance_min_ =
      gauges("armloom_clearance_min_metres", "Smallest clearance of a pair since the start");
  std::map<std::pair<std::string, std::string>, Nearest> nearest_;
  Family<Counter>& findings_ =
      counters("armloom_monitor_findings_total", "Findings of the monitor, by kind");
  Counter& arms_stopped_ =
      counters("armloom_monitor_stopped_arms_total", "Arms that the monitor stopped").Add({});
  Counter& missed_ = counters("armloom_monitor_missed_periods_total",
                              "Monitor periods that began late by a period or more")
                         .Add({});
  Histogram& reactions_ =
      histograms("armloom_monitor_reaction_seconds",
                 "Time from the beginning of a monitor period to the stop commands of its findings")
          .Add({}, kReactions);
  Gauge& slowest_reaction_ = gauges("armloom_monitor_reaction_worst_seconds",
                                    "Longest armloom_monitor_reaction_seconds since the start")
                                 .Add({});
  Histogram& late_ =
      histograms("armloom_monitor_late_seconds",
                 "Time by which a monitor period began more than a period after the one before")
          .Add({}, kReactions);
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> watch_began_;  // the strand's
  Counter& guard_refusals_ =
      counters("armloom_guard_refusals_total",
               "Invalid grants of authority by the scheduler, refused by the guard")
          .Add({});
  Family<Histogram>& periods_ =
      histograms("armloom_period_seconds", "Time between two cycles of a loop");
  Family<Counter>& overruns_ =
      counters("armloom_overruns_total",
               "Cycles that began more than five periods after the previous cycle");
  Family<Gauge>& worst_ = gauges("armloom_period_worst_seconds", "Longest period since the start");
  PeriodWatch control_{watch_parts("control"), kControlPeriod, kOverrunPeriods};
  PeriodWatch monitor_{watch_parts("monitor"),
                       std::chrono::duration<double>(1.0 / cell_->monitor.rate_hz),
                       kOverrunPeriods};
  Histogram& stops_ =
      histograms("armloom_stop_latency_seconds", "Time from a stop request to the executive")
          .Add({}, kLatencies);
  Histogram& transactions_ =
      histograms("armloom_database_seconds", "Duration of a transaction with --data, with its sync")
          .Add({}, kLatencies);
  Family<Counter>& answers_ = counters("armloom_http_requests_total", "Requests answered");
  Family<Counter>& limited_ =
      counters("armloom_limited_total", "Requests, jobs and connections refused by a limit");
  Family<Histogram>& took_ =
      histograms("armloom_http_seconds", "Time from a whole request to its response");
  Gauge& readers_ = gauges("armloom_event_subscribers", "Subscribers of events and poses").Add({});
  Counter& frames_dropped_ =
      counters("armloom_frames_dropped_total", "Pose frames that slow subscribers did not get")
          .Add({});
  Counter& sent_away_ = counters("armloom_subscribers_disconnected_total",
                                 "Subscribers disconnected because they fell too far behind")
                            .Add({});
  Gauge& recording_lost_ =
      gauges("armloom_recording_lost", "1 if the recording is incomplete").Add({});
  Gauge& storage_failed_ =
      gauges("armloom_storage_failed", "1 if jobs cannot be stored; no arm may start").Add({});
  std::map<std::string, Open> open_;  // open jobs by their key; the executive limits their number
};

Metrics::Metrics(CellPtr cell, double speed)
    : impl_(std::make_unique<Impl>(std::move(cell), speed)) {}
Metrics::~Metrics() = default;
void Metrics::ticked() { impl_->ticked(); }
void Metrics::watched(const StateFrame& frame) { impl_->watched(frame); }
void Metrics::watch_begins() { impl_->watch_begins(); }
void Metrics::monitor_stopped(std::size_t arms) { impl_->monitor_stopped(arms); }
void Metrics::judged(std::uint64_t evaluations) { impl_->judged(evaluations); }
void Metrics::set_speed(double speed) { impl_->set_speed(speed); }
void Metrics::stop_taken(std::chrono::nanoseconds after) { impl_->stop_taken(after); }
void Metrics::stored(std::chrono::nanoseconds within) { impl_->stored(within); }
void Metrics::limited(const char* what) { impl_->limited(what); }
void Metrics::happened(const Event& event) { impl_->happened(event); }
void Metrics::answered(const std::string& method, const std::string& route, int status,
                       std::chrono::nanoseconds after) {
  impl_->answered(method, route, status, after);
}
std::string Metrics::text(const Readings& readings) { return impl_->text(readings); }

}  // namespace armloom
