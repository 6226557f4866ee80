#include "server/replay/replay.h"

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/executive/active_policy.h"
#include "core/executive/batch.h"
#include "core/executive/stepped_loop.h"
#include "server/messages/fault.h"
#include "server/messages/job_amendment.h"
#include "server/messages/job_request.h"
#include "server/messages/scene.h"
#include "server/replay/input_text.h"

namespace armloom {
namespace {

using Json = nlohmann::json;

// A line further away is a damaged one: to go there would take an hour, or for ever.
constexpr std::uint64_t kLongestPause = std::chrono::days(31) / kControlPeriod;
constexpr std::uint64_t kCyclesMax = TimePoint::max().time_since_epoch() / kControlPeriod;

Problem unreadable(const std::string& what) {
  return {ProblemKind::invalid, "bad-input-log", "", what};
}

Problem diverged(const std::string& logged, const std::string& here) {
  return {ProblemKind::conflict, "diverged", "",
          "the replay is not as the run was: logged is " + logged + ", here came " + here};
}

template <class Value>
Value value_of(Result<Value> read) {
  if (!read) throw std::invalid_argument(read.error().front().detail);
  return std::move(*read);
}

JobRequest request_of(const Json& logged) {
  if (logged.at("body").is_null()) throw std::invalid_argument("the body of a job is not logged");
  JobRequest job = value_of(read_job_text(logged.at("body").dump()));
  job.body = std::make_shared<const std::string>(logged.at("body").dump());
  job.known.succeeded = logged.value("succeeded", std::vector<std::string>());
  return job;
}

std::vector<JobRequest> requests_of(const Json& line) {
  std::vector<JobRequest> jobs;
  for (const Json& job : line.at("jobs")) jobs.push_back(request_of(job));
  return jobs;
}

std::vector<RestoredJob> restored_of(const Json& line) {
  std::vector<RestoredJob> jobs;
  for (const Json& logged : line.at("jobs")) {
    JobRequest job = request_of(logged);
    apply(value_of(read_job_amendment(logged.at("amended").dump())), job);
    job.key = logged.at("id");
    jobs.push_back({JobId{logged.at("number").get<std::uint64_t>()}, std::move(job),
                    TimePoint(Duration(logged.at("submitted_ns").get<std::int64_t>()))});
  }
  return jobs;
}

CollisionObject object_of(const Json& line) {
  CollisionObject object = value_of(read_object_text(line.at("object").dump(), std::nullopt));
  for (int i = 0; i < 12; ++i) {
    object.X_WO.matrix()(i / 4, i % 4) = line.at("X_WO").at(static_cast<std::size_t>(i));
  }
  return object;
}

// As the server tells it: as a request has it, but for what is not there.
FaultRequest fault_of(Json told) {
  const bool has_value = told.at("kind") == "slow" || told.at("kind") == "late_start";
  told.erase("id");
  if (!has_value) told.erase("value");
  for (const char* time : {"at_s", "for_s"}) {
    if (told.at(time).is_null()) told.erase(time);
  }
  return value_of(read_fault_text(told.dump()));
}

Alert alert_of(const Json& line) {
  return {static_cast<Alert::Level>(line.at("level").get<int>()), line.at("text")};
}

}  // namespace

class Replay::Impl final : public InputLog {
 public:
  explicit Impl(CellPtr cell) : cell_(std::move(cell)) {}

  std::optional<Problems> begin(const Json& head, Observer& observer) {
    ExecutiveOptions options;
    options.policy = head.at("policy");
    options.seed = head.at("seed");
    options.first_job = JobId{head.at("first_job").get<std::uint64_t>()};
    options.inputs = this;
    auto made = SteppedLoop::create(cell_, std::move(options), observer);
    if (!made) return std::move(made.error());
    loop_ = std::move(*made);
    return std::nullopt;
  }

  void came(std::uint64_t ticks, const ExecutiveInput& input) override {
    echo_.push_back(input_text(ticks, input, *cell_));
  }

  Result<void> take(const std::string& text) {
    const Json line = Json::parse(text);
    const std::uint64_t ticks = cycles_before(line);
    if (ticks > loop_->ticks() + kLongestPause) {
      return failure(unreadable("the line lies more than 31 days behind the one before it"));
    }
    while (loop_->ticks() < ticks) loop_->tick();
    echo_.clear();
    const std::string input = line.at("input");
    const auto found = verbs().find(input);
    if (found == verbs().end()) return failure(unreadable("unknown input \"" + input + "\""));
    found->second(*this, line);
    if (echo_.size() == 1 && echo_.front() == text) return {};
    return failure(diverged(text, echo_.empty() ? "nothing" : echo_.back()));
  }

  void run_until(TimePoint time) {
    while (loop_->next() <= time) loop_->tick();
  }

  [[nodiscard]] Executive& executive() const { return loop_->executive(); }

 private:
  using Verb = void (*)(Impl&, const Json&);

  static std::uint64_t cycles_before(const Json& line) {
    const Json& ticks = line.at("ticks");
    if (!ticks.is_number_unsigned()) throw std::invalid_argument("ticks are no number of cycles");
    return ticks.get<std::uint64_t>();
  }

  [[nodiscard]] std::vector<ArmId> arms(const Json& line) const {
    std::vector<ArmId> arms;
    for (const std::string name : line.at("arms")) {
      const auto arm = cell_->find_arm(name);
      if (!arm) throw std::invalid_argument("the cell has no arm \"" + name + "\"");
      arms.push_back(*arm);
    }
    return arms;
  }
  static const std::map<std::string, Verb>& verbs();

  CellPtr cell_;
  std::unique_ptr<SteppedLoop> loop_;
  std::shared_ptr<Executive::Batch> batch_;
  std::vector<std::string> echo_;  // of the present line: what this executive says that came
};

const std::map<std::string, Replay::Impl::Verb>& Replay::Impl::verbs() {
  using Fields = const Json&;
  static const std::map<std::string, Verb> all{
      {"submit",
       [](Impl& my, Fields line) {
         (void)my.executive().submit(std::move(requests_of(line).front()));
       }},
      {"batch",
       [](Impl& my, Fields line) {
         my.batch_ = my.executive().open_batch(requests_of(line), false);
       }},
      {"atomic_batch",
       [](Impl& my, Fields line) {
         my.batch_ = my.executive().open_batch(requests_of(line), true);
       }},
      {"went_on",
       [](Impl& my, Fields) {
         if (my.batch_) (void)my.batch_->go_on();
       }},
      {"restore", [](Impl& my, Fields line) { (void)my.executive().restore(restored_of(line)); }},
      {"cancel", [](Impl& my, Fields line) { (void)my.executive().cancel(line.at("job")); }},
      {"withdraw", [](Impl& my, Fields line) { my.executive().withdraw(line.at("job")); }},
      {"hold",
       [](Impl& my, Fields line) {
         (void)my.executive().cancel(line.at("job"),
                                     TimePoint(Duration(line.at("until_ns").get<std::int64_t>())));
       }},
      {"amend",
       [](Impl& my, Fields line) {
         (void)my.executive().amend(line.at("job"),
                                    value_of(read_job_amendment(line.at("amendment").dump())));
       }},
      {"replan", [](Impl& my, Fields line) { (void)my.executive().replan(line.at("job")); }},
      {"stop", [](Impl& my, Fields line) { my.executive().stop(my.arms(line), line.at("cause")); }},
      {"resume", [](Impl& my, Fields line) { my.executive().resume(my.arms(line)); }},
      {"change_policy",
       [](Impl& my, Fields line) { (void)my.executive().policy().change(line.at("policy")); }},
      {"wind_down",
       [](Impl& my, Fields line) {
         using Waiting = Executive::Waiting;
         const bool kept = line.at("keeps_waiting");
         my.executive().wind_down(line.at("cause"), kept ? Waiting::is_kept : Waiting::ends, [] {});
       }},
      {"add_object",
       [](Impl& my, Fields line) { (void)my.executive().scene().add(object_of(line)); }},
      {"replace_object",
       [](Impl& my, Fields line) { (void)my.executive().scene().replace(object_of(line)); }},
      {"remove_object",
       [](Impl& my, Fields line) { (void)my.executive().scene().remove(line.at("object")); }},
      {"inject",
       [](Impl& my, Fields line) {
         (void)my.executive().faults().inject(fault_of(line.at("fault")));
       }},
      {"remove_fault",
       [](Impl& my, Fields line) { (void)my.executive().faults().remove(line.at("fault")); }},
      {"alert", [](Impl& my, Fields line) { my.executive().alert(alert_of(line)); }},
      {"judged", [](Impl& my, Fields) { my.loop_->answer_question(); }},
      {"planned", [](Impl& my, Fields) { my.loop_->answer_plan(); }},
      {"start_written",
       [](Impl& my, Fields line) {
         my.loop_->write_start(JobId{line.at("job").get<std::uint64_t>()});
       }},
  };
  return all;
}

Result<std::unique_ptr<Replay>> Replay::begin(CellPtr cell, std::string_view head,
                                              Observer& observer) {
  const Json line = Json::parse(head, nullptr, false);
  const bool is_one = line.is_object() && line.contains("armloom_inputs") &&
                      line["armloom_inputs"] == InputLogHead::kVersion;
  if (!is_one) return failure(unreadable("this is no log of inputs of this version of armloom"));
  auto impl = std::make_unique<Impl>(std::move(cell));
  try {
    if (auto problems = impl->begin(line, observer)) return failure(std::move(*problems));
  } catch (const Json::exception& fault) {
    return failure(unreadable(fault.what()));
  }
  return std::unique_ptr<Replay>(new Replay(std::move(impl)));
}

Replay::Replay(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Replay::~Replay() = default;

Result<void> Replay::take(std::string_view line) {
  try {
    return impl_->take(std::string(line));
  } catch (const Json::exception& fault) {
    return failure(unreadable(fault.what()));
  } catch (const std::invalid_argument& fault) {
    return failure(unreadable(fault.what()));
  }
}

void Replay::run_until(TimePoint time) { impl_->run_until(time); }
const Executive& Replay::executive() const { return impl_->executive(); }

std::optional<TimePoint> Replay::time_of(std::string_view text) {
  const Json line = Json::parse(text, nullptr, false);
  const bool is_one =
      line.is_object() && line.contains("ticks") && line["ticks"].is_number_unsigned();
  if (!is_one || line["ticks"] > kCyclesMax) return std::nullopt;
  return TimePoint(line["ticks"].get<std::int64_t>() * kControlPeriod);
}

}  // namespace armloom
