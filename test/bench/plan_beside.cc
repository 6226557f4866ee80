// plan_beside CELL [QUERIES]
// Planning time alongside moving arms, and whether the admitted motion is the planned one. The
// first two arms move between random poses. The last arm gets QUERIES (1000) jobs with `move_to`
// and is stopped once a job is admitted. Every 20th query changes a distant object, so that plans
// become out of date.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

#include "core/collision/check/line_checker.h"
#include "core/collision/check/motion_checker.h"
#include "core/executive/executive.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/cell_codec.h"

namespace armloom {
namespace {

using Clock = std::chrono::steady_clock;

CellPtr load(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  std::ostringstream text;
  text << in.rdbuf();
  Problems problems;
  const auto folder = std::filesystem::path(file).parent_path();
  auto cell = build_cell(read_cell_text(text.str(), folder, problems), problems);
  if (!cell) throw std::runtime_error(file + ": " + cell.error().front().detail);
  if (cell.value()->arms.size() < 3) throw std::runtime_error(file + ": three arms are needed");
  return *cell;
}

class TimedJudge final : public JudgementService {
 public:
  explicit TimedJudge(ArmId asked) : asked_(asked) {}

  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    if (!checker_) checker_.emplace(scene);
    checker_->look_at(std::move(scene));
    later(kSimulatedJudgement,
          [verdict = checker_->judge(question), done = std::move(done)] { done(verdict); });
  }
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  void plan(PlanTask task) override {
    const auto begun = Clock::now();
    PlanAnswer answer = answer_of(task);
    if (task.question.goal.arm == asked_) {
      ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begun).count());
      solved += answer.has_value();
      last_start = joints_of(task.question.at, task.scene->cell().arm(asked_).joints);
      last_scene = task.scene;
    }
    later(kSimulatedPlanning,
          [answer = std::move(answer), done = std::move(task.done)] { done(answer); });
  }
  bool draft(PlanTask task) override { return plan(std::move(task)), true; }

  void deliver(TimePoint now) {
    now_ = now;
    while (!pending_.empty() && pending_.front().first <= now) {
      const auto done = std::move(pending_.front().second);
      pending_.pop_front();
      done();
    }
  }

  std::vector<double> ms;
  std::size_t solved = 0;
  Eigen::VectorXd last_start;
  PlanningScenePtr last_scene;

 private:
  void later(Duration takes, std::function<void()> done) {
    const auto due = now_ + takes;
    const auto at =
        std::ranges::upper_bound(pending_, due, {}, [](const auto& p) { return p.first; });
    pending_.emplace(at, due, std::move(done));
  }
  ArmId asked_;
  std::optional<MotionChecker> checker_;
  TimePoint now_{};
  std::deque<std::pair<TimePoint, std::function<void()>>> pending_;
};

struct NoObserver final : Observer {
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration& q) override { measured = q; }
  void on_state(const StateFrame&) override {}
  Configuration measured;
};

class Queries {
 public:
  Queries(CellPtr cell, int count)
      : cell_(std::move(cell)),
        asked_(static_cast<std::uint32_t>(cell_->arms.size() - 1)),
        judge_(asked_),
        count_(count) {
    auto created = Executive::create(cell_, ExecutiveOptions{}, judge_, seen_);
    if (!created) throw std::runtime_error(created.error().front().detail);
    executive_ = std::move(*created);
  }

  int run() {
    for (int query = 0; query < count_; ++query) {
      const std::string key = "q" + std::to_string(query);
      if (!executive_->submit(to_random_place(asked_, key))) throw std::runtime_error("refused");
      tick();
      if (query % 20 == 19) change_scene();
      follow(key);
    }
    return report();
  }

 private:
  // Returns a job to a random place that is free while all other arms are at home.
  JobRequest to_random_place(ArmId id, const std::string& key) {
    const Arm& arm = cell_->arm(id);
    const auto scene = judge_.last_scene ? judge_.last_scene : *PlanningScene::build(cell_);
    LineChecker lines(scene, id, cell_->home(), cell_->checking.tracking_error_rad);
    Eigen::VectorXd q(arm.home.size());
    do {
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        const Joint& joint = cell_->joint(arm.joints[static_cast<std::size_t>(j)]);
        q[j] = std::uniform_real_distribution(joint.lower, joint.upper)(random_);
      }
    } while (!lines.is_free(q, q));
    JobRequest job{.key = key, .name = "", .trajectory = {}};
    job.arm = arm.name;
    job.move_to =
        PlanGoal{.joints = std::vector<double>(q.begin(), q.end()), .named = {}, .pose = {}};
    return job;
  }

  void keep_moving(ArmId arm) {
    const auto jobs = executive_->snapshot(0).jobs;
    const auto& name = cell_->arm(arm).name;
    const auto of_it = [&](const JobView& job) { return job.arms.front() == name; };
    if (std::ranges::count_if(jobs, of_it) < 2) {
      (void)executive_->submit(to_random_place(arm, "m" + std::to_string(movers_++)));
    }
  }

  void tick() {
    now_ += kControlPeriod;
    executive_->tick(now_);
    judge_.deliver(now_);
    if (++ticks_ % 100 == 0) {
      keep_moving(ArmId{0});
      keep_moving(ArmId{1});
    }
  }

  void change_scene() {
    CollisionObject fly{.name = "fly" + std::to_string(ticks_), .shape = Box{{0.1, 0.1, 0.1}}};
    fly.X_WO.translation() = Eigen::Vector3d(5.0, 5.0, 5.0);
    if (!fly_.empty()) (void)executive_->scene().remove(fly_);
    if (executive_->scene().add(fly)) fly_ = fly.name;
  }

  // Ticks until the job is admitted or has ended. Then cancels the job, so that the next can be
  // submitted.
  void follow(const std::string& key) {
    const std::size_t plans_before = judge_.ms.size() - 1;
    const TimePoint limit = now_ + std::chrono::seconds(10);
    while (now_ < limit) {
      const JobView job = *executive_->job(key);
      if (is_terminal(job.state)) break;
      if (job.state == JobState::scheduled || job.state == JobState::running) {
        note_admitted(key);
        break;
      }
      tick();
    }
    again_ += judge_.ms.size() - plans_before - 1;
    (void)executive_->cancel(key);
    while (!is_terminal(executive_->job(key)->state)) tick();
  }

  // Counts the motion as out of date unless it starts at the arm's position and was planned in the
  // present scene.
  void note_admitted(const std::string& key) {
    ++admitted_;
    const Trajectory& motion = *executive_->inquiries().trajectory(key);
    const bool from_there = motion.start().isApprox(judge_.last_start, 1e-6);
    const auto& objects = judge_.last_scene->objects();
    const bool same_scene = std::ranges::equal(objects, executive_->scene().objects(), {},
                                               &CollisionObject::name, &CollisionObject::name);
    if (!from_there || !same_scene) ++stale_;
  }

  int report() {
    std::ranges::sort(judge_.ms);
    const auto at = [&](double share) {
      return judge_.ms[static_cast<std::size_t>(share * static_cast<double>(judge_.ms.size() - 1))];
    };
    std::printf(
        "%d queries beside two moving arms: %zu plans, %zu solved, %zu made again; ms: median "
        "%.2f, p95 %.1f, most %.0f\n",
        count_, judge_.ms.size(), judge_.solved, again_, at(0.5), at(0.95), at(1.0));
    std::printf("%zu admitted, %zu of these on something else than they were planned on\n",
                admitted_, stale_);
    return stale_ == 0 ? 0 : 1;
  }

  CellPtr cell_;
  ArmId asked_;
  TimedJudge judge_;
  NoObserver seen_;
  std::unique_ptr<Executive> executive_;
  int count_;
  std::mt19937_64 random_{1};
  TimePoint now_{};
  std::uint64_t ticks_ = 0;
  std::uint64_t movers_ = 0;
  std::string fly_;
  std::size_t again_ = 0;
  std::size_t admitted_ = 0;
  std::size_t stale_ = 0;
};

}  // namespace
}  // namespace armloom

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "plan_beside CELL [QUERIES]\n";
    return 2;
  }
  try {
    const int queries = argc > 2 ? std::max(1, std::atoi(argv[2])) : 1000;
    return armloom::Queries(armloom::load(argv[1]), queries).run();
  } catch (const std::exception& error) {
    std::cerr << "plan_beside: " << error.what() << '\n';
    return 2;
  }
}
