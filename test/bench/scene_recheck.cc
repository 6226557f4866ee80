// scene_recheck [CHANGES]
// Sets 500 boxes at once while four Pandas move, again and again, in real time. Prints how long the
// change and the checks of all motions in the new scene take, and whether control cycles were
// missed. Exit code 1 if an arm did not move, or nothing was checked.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/executive/real_time_loop.h"
#include "core/executive/status_board.h"
#include "test/bench/cells.h"

namespace armloom::bench {
namespace {

using Wall = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::size_t kArms = 4;
constexpr std::size_t kBoxes = 500;
constexpr double kMotion_s = 300.0;
constexpr auto kPause = 250ms;  // between two changes
// As in armloom_overruns_total: a cycle that comes later than five periods.
constexpr auto kOverrun = 5 * kControlPeriod;

double ms(Wall::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

// Notes the times of ticks and answers.
class Watch final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint, const Configuration&) override {
    const auto now = Wall::now();
    timespec used{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    const Wall::duration work =
        std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
    if (last_tick_) {
      const std::scoped_lock lock(mutex_);
      figures_.overruns += now - *last_tick_ > kOverrun;
      figures_.longest = std::max(figures_.longest, now - *last_tick_);
      figures_.works_too_long += work - last_work_ > kControlPeriod;
      figures_.longest_work = std::max(figures_.longest_work, work - last_work_);
    }
    last_tick_ = now;
    last_work_ = work;
  }
  void on_judged(std::uint64_t) override {
    const std::scoped_lock lock(mutex_);
    judged_.push_back(Wall::now());
  }
  std::vector<Wall::time_point> take_judged() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(judged_, {});
  }
  // Counts the control cycles since the last call.
  struct Figures {
    int overruns = 0;
    Wall::duration longest{};
    int works_too_long = 0;  // processor time of the loop's thread in a cycle: above one period
    Wall::duration longest_work{};
  };
  Figures take_figures() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(figures_, {});
  }

 private:
  std::optional<Wall::time_point> last_tick_;
  Wall::duration last_work_{};
  Figures figures_;
  std::mutex mutex_;
  std::vector<Wall::time_point> judged_;
};

JobRequest swing(const Cell& cell, std::uint32_t arm) {
  const Arm& moved = cell.arm(ArmId{arm});
  JobRequest job;
  std::vector<double> home, there;
  for (Eigen::Index i = 0; i < moved.home.size(); ++i) {
    job.trajectory.joint_names.push_back(
        cell.joint(moved.joints[static_cast<std::size_t>(i)]).name);
    home.push_back(moved.home[i]);
    there.push_back(moved.home[i] + 0.1);
  }
  const std::vector<double> still(home.size(), 0.0);
  job.trajectory.points = {
      {.positions = home, .velocities = still, .time_from_start_s = 0.0},
      {.positions = there, .velocities = still, .time_from_start_s = kMotion_s}};
  return job;
}

// Boxes of two sizes within the arms' reach, but not beside their paths.
ObjectsSet boxes(std::uint32_t seed, const Cell& cell) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> flat(-2.0, 2.0), up(0.15, 0.9);
  std::vector<CollisionObject> all;
  while (all.size() < kBoxes) {
    const Eigen::Vector3d at(flat(random), flat(random), up(random));
    double nearest_m = 10.0;
    for (const Robot& robot : cell.robots) {
      const Eigen::Vector3d beside = at - robot.X_WB.translation();
      nearest_m = std::min(nearest_m, std::hypot(beside.x(), beside.y()));
    }
    if (nearest_m < 0.7 || nearest_m > 1.0) continue;
    const double side_m = all.size() % 2 == 0 ? 0.04 : 0.03;
    CollisionObject box{"v" + std::to_string(all.size()), Box{Eigen::Vector3d::Constant(side_m)},
                        Eigen::Isometry3d::Identity()};
    box.X_WO.translation() = at;
    all.push_back(std::move(box));
  }
  return {.objects = std::make_shared<const std::vector<CollisionObject>>(std::move(all))};
}

void print(const char* what, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  std::printf("%-52s median %6.1f, 99 %% %6.1f, longest %6.1f ms\n", what, at(0.5), at(0.99),
              times_ms.back());
}

void print(const char* when, const Watch::Figures& figures) {
  std::printf(
      "%s: %d cycles later than 5 ms (longest %.1f ms); in %d the loop worked for more than "
      "1 ms (longest %.2f ms)\n",
      when, figures.overruns, ms(figures.longest), figures.works_too_long,
      ms(figures.longest_work));
}

int run(int changes) {
  const CellPtr cell = circle_of_pandas(kArms, 0.8);
  Watch watch;
  const auto started = RealTimeLoop::start(cell, {}, 1.0, watch);
  if (!started) throw std::runtime_error(started.error().front().detail);
  RealTimeLoop& loop = **started;
  loop.post([&](Executive& executive) {
    for (std::uint32_t arm = 0; arm < kArms; ++arm) {
      if (const auto job = executive.submit(swing(*cell, arm)); !job) {
        std::fprintf(stderr, "%s\n", job.error().front().detail.c_str());
      }
    }
  });
  const auto running = [&] {
    const auto jobs = loop.board().read().jobs_with_ended(0);
    return static_cast<std::size_t>(std::ranges::count_if(
        jobs, [](const auto& job) { return job->state == JobState::running; }));
  };
  for (int i = 0; i < 100 && running() < kArms; ++i) std::this_thread::sleep_for(100ms);
  std::this_thread::sleep_for(1s);
  (void)watch.take_judged();
  (void)watch.take_figures();
  std::this_thread::sleep_for(changes * kPause);
  std::printf("%zu arms move\n", running());
  print("without changes", watch.take_figures());

  std::vector<double> swap_ms, checked_ms, total_ms;
  for (int i = 0; i < changes; ++i) {
    const ObjectsSet set = boxes(static_cast<std::uint32_t>(i + 1), *cell);
    std::promise<Wall::time_point> done;
    const auto begun = Wall::now();
    loop.edit_scene(set, nullptr, [&](const Result<SceneEdited>& edited) {
      if (!edited) std::fprintf(stderr, "%s\n", edited.error().front().detail.c_str());
      done.set_value(Wall::now());
    });
    const auto swapped = done.get_future().get();
    std::this_thread::sleep_until(begun + kPause);
    const auto judged = watch.take_judged();
    swap_ms.push_back(ms(swapped - begun));
    if (judged.empty()) continue;
    checked_ms.push_back(ms(judged.back() - swapped));
    total_ms.push_back(ms(judged.back() - begun));
  }
  print("with changes", watch.take_figures());
  std::this_thread::sleep_for(changes * kPause);
  print("with the boxes, without changes", watch.take_figures());
  std::printf("%d changes of %zu boxes; %zu arms move\n", changes, kBoxes, running());
  if (running() < kArms || checked_ms.size() < static_cast<std::size_t>(changes)) {
    std::fprintf(stderr, "an arm does not move, or only %zu changes led to checks\n",
                 checked_ms.size());
    return 1;
  }
  print("request to the new scene", swap_ms);
  print("new scene until all motions are checked (limit 50)", checked_ms);
  print("both", total_ms);
  return 0;
}

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) {
  return armloom::bench::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 40);
}
