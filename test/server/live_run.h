#pragma once

// Random runs of an executive with two Pandas that record the log of its inputs and its events.
// Verdicts, plans and store acknowledgements arrive after random delays, as on a busy machine.

#include <atomic>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/executive/batch.h"
#include "core/executive/validated.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/codec/read_text.h"
#include "server/messages/events.h"
#include "server/messages/job_request.h"
#include "server/recording/recording.h"
#include "server/replay/input_format.h"
#include "test/server/panda_jobs.h"
#include "test/source_dir.h"

namespace armloom::test {

using namespace std::chrono_literals;
using nlohmann::json;

inline CellPtr two_pandas() {
  static const CellPtr cell = [] {
    const auto file = std::filesystem::path(source_dir()) / "config/two_pandas.json";
    const auto text = read_text_file(file);
    return *build_cell(*read_cell_text(*text, file.parent_path()));
  }();
  return cell;
}

class Told : public Observer {
 public:
  void on_event(const Event& event) override {
    events.push_back(event_json(event, "stream", nullptr));
    if (const auto* job = std::get_if<JobView>(&event.body)) ++ended[to_string(job->state)];
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
  std::vector<std::string> events;
  std::map<std::string, int> ended;
};

class LiveRun final : public JudgementService, public StartLog, public InputLog, public Told {
 public:
  LiveRun(std::uint64_t seed, const std::string& policy) : random_(seed) {
    ExecutiveOptions options;
    options.policy = policy;
    options.seed = seed;
    options.starts = this;
    options.inputs = this;
    log.push_back(text_of(*input_log_head_format(), {policy, seed, 1}));
    executive_ = std::move(*Executive::create(two_pandas(), std::move(options), *this, *this));
  }

  void run(int ticks) {
    restore();
    for (int i = 0; i < ticks; ++i) {
      deliver();
      if (random_() % 100 == 0) act();
      if (batch_ && random_() % 2 == 0 && batch_->go_on()) batch_.reset();
      executive_->tick(now_);
      if (executive_->scene().due(now_)) {
        later([this] { (void)executive_->scene().edit(ObjectsExpired{}); });
      }
      now_ += kControlPeriod;
    }
    executive_->wind_down("the run ends", Executive::Waiting::is_kept, [] {});
    for (int i = 0; i < 300; ++i, now_ += kControlPeriod) executive_->tick(now_);
  }

  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    answer(checker_, question, std::move(scene), std::move(done));
  }
  void certify(Question question, PlanningScenePtr scene,
               std::function<void(Verdict)> done) override {
    answer(certifier_, question, std::move(scene), std::move(done));
  }
  bool consider(Question question, PlanningScenePtr scene,
                std::function<void(Verdict)> done) override {
    answer(clients_checker_, question, std::move(scene), std::move(done));
    return true;
  }
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  bool draft(PlanTask task) override {
    later([task = std::move(task)] { task.done(answer_of(task)); });
    return true;
  }
  void plan(PlanTask task) override {
    planned_by_ = std::max(planned_by_, now_) + Duration(random_() % 40) * kControlPeriod.count();
    pending_.emplace(planned_by_, [task = std::move(task)] { task.done(answer_of(task)); });
  }
  void about_to_move(JobId, std::function<void()> written) override { later(std::move(written)); }
  void has_moved(JobId, const HeldView&, std::function<void()> written) override {
    later(std::move(written));
  }
  void came(std::uint64_t ticks, const ExecutiveInput& input) override {
    log.push_back(text_of(*logged_input_format(), {ticks, input}));
  }

  [[nodiscard]] TimePoint ended_at() const { return now_ - kControlPeriod; }
  [[nodiscard]] const Executive& executive() const { return *executive_; }
  std::vector<std::string> log;
  std::size_t planned = 0;  // number of /plan inquiries that found a path
  // Number of checks of jobs with steps that went on after the first motion.
  std::size_t further_steps_checked = 0;

 private:
  void answer(std::optional<MotionChecker>& checker, const Question& question,
              PlanningScenePtr scene, std::function<void(Verdict)> done) {
    if (!checker) checker.emplace(scene);
    checker->look_at(std::move(scene));
    later([verdict = checker->judge(question), done = std::move(done)] { done(verdict); });
  }
  void later(std::function<void()> answer) {
    pending_.emplace(now_ + Duration(random_() % 12) * kControlPeriod.count(), std::move(answer));
  }
  void deliver() {
    while (!pending_.empty() && pending_.begin()->first <= now_) {
      const auto node = pending_.extract(pending_.begin());
      node.mapped()();
    }
  }

  void restore() {
    if (random_() % 2 == 0) return;
    if (executive_->scene().add(object())) {
      executive_->scene().restore(
          {TimePoint(300ms), std::make_shared<const std::vector<std::string>>(1, "crate")});
    }
    std::vector<RestoredJob> jobs;
    jobs.push_back({JobId{1}, request(swing("left")), TimePoint(-3s)});
    jobs.back().request.key = "former";
    jobs.back().request.terms.priority = 3;
    stop_all(*executive_, "started again");
    (void)executive_->restore(std::move(jobs));
    resume_all(*executive_);
  }
  JobRequest request(json body) {
    JobRequest job = read_job(body).value();
    job.body = std::make_shared<const std::string>(body.dump());
    if (random_() % 2 == 0) validate_ahead(job, *two_pandas());
    return job;
  }
  std::string arm() { return random_() % 2 == 0 ? "left" : "right"; }
  // Returns a motion from home and back.
  json swing(const std::string& arm) {
    test::Pose there = random_() % 3 == 0 ? test::kMiddle : test::kHome;
    there[0] += 0.1 * static_cast<double>(random_() % 5);
    json job = test::move(arm, test::kHome, there, 1.5, 3);
    const json back = test::move(arm, there, test::kHome, 1.5, 3);
    for (std::size_t i = 1; i < 3; ++i) {
      json point = back["trajectory"]["points"][i];
      point["time_from_start"] = point["time_from_start"].get<double>() + 1.5;
      job["trajectory"]["points"].push_back(point);
    }
    job["priority"] = random_() % 3;
    job["backlog_timeout_s"] = 0.5 + 0.25 * static_cast<double>(random_() % 8);
    if (random_() % 3 == 0) job["move_to_start"] = "plan";
    if (random_() % 4 == 0) job["reorderable"] = true;
    if (random_() % 4 == 0) job["on_timeout"] = "replan";
    return job;
  }
  std::string some_job() {
    const Snapshot now = executive_->snapshot();
    return now.jobs.empty() ? "nobody" : now.jobs[random_() % now.jobs.size()].key;
  }
  CollisionObject object() {
    const double x = 0.3 * static_cast<double>(random_() % 7) - 0.9;
    CollisionObject object{"crate", Box{{0.1, 0.2, 0.3}}, Eigen::Isometry3d::Identity()};
    object.X_WO.translate(Eigen::Vector3d(x, 0.55, 0.7))
        .rotate(Eigen::AngleAxisd(0.1 * x + 0.3, Eigen::Vector3d(1, 2, 3).normalized()));
    return object;
  }

  void act() {
    switch (random_() % 30) {
      case 0:
        return executive_->stop({ArmId{static_cast<std::uint32_t>(random_() % 2)}},
                                "\"operator\"\n");
      case 1:
      case 2:
      case 15:
      case 16:
        return (void)resume_all(*executive_);
      case 3:
        return (void)executive_->cancel(some_job());
      case 4:
        return (void)executive_->amend(
            some_job(), {.name = "named", .terms = {.priority = 7, .backlog_timeout = 1234567ns}});
      case 5:
        return (void)executive_->replan(some_job());
      case 6:
        return (void)executive_->scene().add(object());
      case 7:
        return (void)executive_->scene().replace(object());
      case 8:
        return (void)executive_->scene().remove("crate");
      case 17:
        return (void)executive_->scene().edit(
            ObjectsSet{std::make_shared<const std::vector<CollisionObject>>(1, object()),
                       Duration(random_() % 400) * kControlPeriod.count()});
      case 9:
        return (void)executive_->faults().inject(
            {.arm = arm(), .kind = ArmFault::Kind::slow, .lasting = 300ms, .value = 0.3});
      case 10:
        return (void)executive_->faults().inject({.arm = arm(), .kind = ArmFault::Kind::stall});
      case 11:
        return (void)executive_->faults().remove(1 + random_() % 4);
      case 12: {
        if (batch_) return;
        std::vector<JobRequest> jobs;
        for (int i = 0; i < 4; ++i) jobs.push_back(request(swing(arm())));
        batch_ = executive_->open_batch(std::move(jobs), random_() % 2 == 0);
        return;
      }
      case 13:
        return executive_->alert({Alert::Level::warning, "late by 0.3 s"});
      case 14:
        return (void)executive_->submit(
            request({{"arm", arm()}, {"move_to", {{"named", "ready"}}}}));
      case 24:
      case 25:
        return (void)executive_->cancel(some_job(),
                                        now_ + Duration(random_() % 800) * kControlPeriod.count());
      case 26:  // checks and plans are not logged and change nothing, however long they take
        return executive_->inquiries().check(request(swing(arm())), [](const auto&) {});
      case 27:
        return ask_about_steps();
      case 28:
        return plan();
      case 29:
        return executive_->roll_back(some_job());
      default:
        if (!batch_) (void)executive_->submit(request(swing(arm())));
    }
  }

  void plan() {
    PlanInquiry inquiry{.to = {.named = "ready"}, .seed = random_()};
    if (random_() % 2 == 0) {
      inquiry.arms = {"left", "right"};
    } else {
      inquiry.arm = arm();
    }
    executive_->inquiries().plan(std::move(inquiry), std::make_shared<std::atomic<bool>>(false),
                                 [this](const auto& outcome) { planned += outcome && *outcome; });
  }

  void ask_about_steps() {
    const std::string first = arm(), second = arm();
    const json ready = {{"named", "ready"}}, home = {{"named", "home"}};
    JobRequest job = request({{"steps",
                               {{{"arm", first}, {"move_to", ready}},
                                {{"gripper", {{"arm", first}, {"width_m", 0.05}}}},
                                {{"arm", second}, {"move_to", home}},
                                {{"arm", first}, {"move_to", home}}}}});
    executive_->inquiries().plan(StepsInquiry{job, random_()},
                                 std::make_shared<std::atomic<bool>>(false), [](const auto&) {});
    executive_->inquiries().check(std::move(job), [this](const Result<CheckView>& view) {
      further_steps_checked += view && view->step.value_or(1) > 0;
    });
  }

  std::mt19937_64 random_;
  std::unique_ptr<Executive> executive_;
  std::optional<MotionChecker> checker_, certifier_, clients_checker_;
  std::multimap<TimePoint, std::function<void()>> pending_;
  TimePoint planned_by_{};
  std::shared_ptr<Executive::Batch> batch_;
  TimePoint now_{};
};

}  // namespace armloom::test
