#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <thread>

#include "core/executive/real_time_loop.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/messages/job_request.h"
#include "server/recording/recording.h"
#include "test/server/panda_jobs.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

CellPtr two_pandas() {
  const auto file = std::filesystem::path(source_dir()) / "config/two_pandas.json";
  return *build_cell(*read_cell_text(*read_text_file(file), file.parent_path()));
}

class Queues final : public Observer {
 public:
  void on_event(const Event& event) override {
    if (const auto* queue = std::get_if<QueueView>(&event.body)) {
      ++told;
      last = *queue;
    }
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
  std::size_t told = 0;
  QueueView last;
};

TEST(Strand, RunsCyclesAndUrgentTasksBetweenPartsOfALongTask) {
  Queues observer;
  const auto loop = RealTimeLoop::start(two_pandas(), {}, 1.0, observer);
  ASSERT_TRUE(loop);
  constexpr int kParts = 100;
  int parts = 0, parts_at_stop = -1, parts_at_next = -1;
  TimePoint begun{}, ended{};
  std::promise<void> done;
  (*loop)->post_in_parts([&](Executive& executive) {
    if (parts++ == 0) {
      begun = executive.now();
      (*loop)->post([&](Executive&) {
        parts_at_next = parts;
        done.set_value();
      });
      (*loop)->post_urgent([&](Executive& stopped) {
        parts_at_stop = parts;
        stop_all(stopped, "operator");
      });
    }
    std::this_thread::sleep_for(1ms);
    ended = executive.now();
    return parts == kParts;
  });
  ASSERT_EQ(done.get_future().wait_for(20s), std::future_status::ready);
  EXPECT_LE(parts_at_stop, 1);
  EXPECT_EQ(parts_at_next, kParts);
  EXPECT_GE(ended - begun, 30ms) << "cell time stood still";
}

class Alerts final : public Observer {
 public:
  void on_event(const Event& event) override {
    const auto* alert = std::get_if<Alert>(&event.body);
    if (alert == nullptr) return;
    told.push_back(alert->text);
    if (told.size() == 1) first.set_value();
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
  std::vector<std::string> told;  // loop thread only
  std::promise<void> first;
};

TEST(Strand, ReportsADelayedLoopOnce) {
  Alerts alerts;
  const auto loop = RealTimeLoop::start(two_pandas(), {}, 1.0, alerts);
  ASSERT_TRUE(loop);
  const auto hold_up = [&] {
    (*loop)->post([](Executive&) { std::this_thread::sleep_for(600ms); });
  };
  hold_up();
  ASSERT_EQ(alerts.first.get_future().wait_for(20s), std::future_status::ready);
  hold_up();
  std::promise<std::vector<std::string>> told;
  TimePoint at{};
  (*loop)->post_in_parts([&](Executive& executive) {  // until cycles continue after the delay
    if (at == TimePoint{}) at = executive.now();
    if (executive.now() - at < 20ms) return false;
    told.set_value(alerts.told);
    return true;
  });
  const auto texts = told.get_future().get();
  ASSERT_EQ(texts.size(), 1U) << "of a busy machine it is said once in a minute";
  EXPECT_TRUE(texts[0].starts_with("the control loop was delayed by ")) << texts[0];
}

TEST(Strand, PublishesALongQueueRarelyButAStopAtOnce) {
  constexpr std::size_t kJobs = 400;
  Queues observer;
  const auto simulation = Simulation::create(two_pandas(), {}, observer);
  ASSERT_TRUE(simulation);
  Executive& executive = (*simulation)->executive();
  (*simulation)->tick();
  std::vector<JobRequest> jobs;
  for (std::size_t i = 0; i < kJobs; ++i) {
    nlohmann::json body = test::move(i % 2 == 0 ? "left" : "right", test::kHome, test::kHome);
    jobs.push_back(read_job(body).value());
  }
  ASSERT_TRUE(submit_batch(executive, std::move(jobs), true));
  EXPECT_LE(observer.told, 110U) << "lists of hundreds are not made for each change";
  stop_all(executive, "operator");
  EXPECT_TRUE(observer.last.stopped);
  (*simulation)->run_until(TimePoint(200ms));
  const QueueView& last = observer.last;
  EXPECT_EQ(last.queued.size() + last.backlog.size() + last.scheduled.size() + last.running.size(),
            kJobs)
      << "what was left out is told later";
}

}  // namespace
}  // namespace armloom
