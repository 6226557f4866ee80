// longest_step CELL JOBS [POLICY]
// Measures how long the strand is blocked. Runs a jobs file on simulated time and prints the
// longest control cycles and the longest submission (processor time). The time of checks is
// subtracted, because servers run checks on other threads.
#include <time.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <vector>

#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/messages/job_request.h"

namespace armloom::bench {
namespace {

class NoObserver final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

template <class T>
T value_of(Result<T> result) {
  if (result) return std::move(*result);
  for (const Problem& problem : result.error()) {
    std::cerr << problem.pointer << ": " << problem.detail << "\n";
  }
  throw std::runtime_error("bad input");
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double share(const std::vector<double>& sorted, double of_all) {
  return sorted[static_cast<std::size_t>(of_all * static_cast<double>(sorted.size() - 1))];
}

void run(const std::string& cell_file, const std::string& jobs_file, const std::string& policy) {
  const std::string folder = cell_file.substr(0, cell_file.find_last_of('/') + 1);
  const CellPtr cell =
      value_of(build_cell(value_of(read_cell_text(text_of(cell_file), folder + "."))));
  std::vector<TimedJob> jobs = value_of(read_jobs_text(text_of(jobs_file)));
  NoObserver observer;
  const auto simulation = value_of(Simulation::create(cell, {.policy = policy}, observer));
  Executive& executive = simulation->executive();
  std::vector<double> cycles_ms, submissions_ms, judging_ms;
  auto next = jobs.begin();
  const TimePoint limit{std::chrono::hours(1)};
  while (!(next == jobs.end() && executive.all_ended()) && simulation->now() < limit) {
    const Duration judged = simulation->judging().wall;
    double begun_ms = processor_ms();
    simulation->tick();
    const double judging = 1e3 * to_seconds(simulation->judging().wall - judged);
    cycles_ms.push_back(std::max(0.0, processor_ms() - begun_ms - judging));
    if (judging > 0.0) judging_ms.push_back(judging);
    for (; next != jobs.end() && next->at <= executive.now(); ++next) {
      const Duration before = simulation->judging().wall;
      begun_ms = processor_ms();
      (void)value_of(executive.submit(std::move(next->job)));
      const double off = 1e3 * to_seconds(simulation->judging().wall - before);
      submissions_ms.push_back(std::max(0.0, processor_ms() - begun_ms - off));
    }
  }
  const auto tell = [](const char* what, std::vector<double> ms) {
    if (ms.empty()) return;
    std::ranges::sort(ms);
    std::cout << what << ": " << ms.size() << ", median " << share(ms, 0.5) << " ms, 99 % "
              << share(ms, 0.99) << " ms, longest " << ms.back() << " ms\n";
  };
  tell("control cycles", cycles_ms);
  tell("submissions", submissions_ms);
  tell("cycles' judging (wall)", judging_ms);
}

}  // namespace
}  // namespace armloom::bench

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::cerr << "longest_step CELL JOBS [POLICY]\n";
    return 2;
  }
  armloom::bench::run(argv[1], argv[2], argc > 3 ? argv[3] : "");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
