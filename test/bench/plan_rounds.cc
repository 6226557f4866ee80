#include "test/bench/plan_rounds.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "server/codec/json_writer.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

PoseGroups::PoseGroups(std::size_t poses) : above_(poses) {
  std::iota(above_.begin(), above_.end(), std::size_t{0});
}

std::size_t PoseGroups::root(std::size_t pose) const {
  while (above_[pose] != pose) pose = above_[pose];
  return pose;
}

void PoseGroups::join(std::size_t a, std::size_t b) { above_[root(a)] = root(b); }

bool PoseGroups::are_joined(std::size_t a, std::size_t b) const { return root(a) == root(b); }

bool PoseGroups::are_parted(std::size_t a, std::size_t b) const {
  return std::ranges::any_of(parted_, [&](const auto& pair) {
    const auto [one, other] = pair;
    return (are_joined(one, a) && are_joined(other, b)) ||
           (are_joined(one, b) && are_joined(other, a));
  });
}

void PlanRounds::add(std::size_t from, std::size_t to, TrajectoryRequest way) {
  ways_[from].insert_or_assign(to, std::move(way));
}

std::vector<const TrajectoryRequest*> PlanRounds::round_from(std::size_t first) const {
  std::map<std::size_t, std::vector<std::size_t>> left;
  for (const auto& [from, ways] : ways_) {
    for (const auto& [to, way] : ways) left[from].push_back(to);
  }
  std::vector<std::size_t> open{first}, round;
  while (!open.empty()) {
    auto& next = left[open.back()];
    if (next.empty()) {
      round.push_back(open.back());
      open.pop_back();
    } else {
      open.push_back(next.back());
      next.pop_back();
    }
  }
  std::ranges::reverse(round);
  std::vector<const TrajectoryRequest*> jobs;
  for (std::size_t i = 0; i + 1 < round.size(); ++i) {
    const auto way = ways_.at(round[i]).find(round[i + 1]);
    if (way == ways_.at(round[i]).end()) break;
    jobs.push_back(&way->second);
  }
  return jobs;
}

void write_jobs(const std::string& file,
                const std::vector<std::vector<const TrajectoryRequest*>>& rounds) {
  JsonWriter out;
  out.begin_array();
  std::size_t job = 0;
  for (const auto& round : rounds) {
    for (std::size_t i = 0; i < round.size(); ++i, ++job) {
      out.begin_object().field("at", 0.0).key("job").begin_object();
      out.field("id", "w" + std::to_string(job));
      out.field("backlog_timeout_s", 1e6);
      if (i == 0 && job > 0) {
        out.key("after").begin_array().value("w" + std::to_string(job - 1)).end_array();
      }
      out.key("trajectory");
      trajectory_request_format()->write(out, *round[i]);
      out.end_object().end_object();
    }
  }
  out.end_array();
  std::ofstream to(file);
  to << out.take() << '\n';
  if (!to.flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace armloom
