#include "core/audit/audit.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "core/audit/audited_cell.h"

namespace armloom {
namespace {

class Audit {
 public:
  Audit(const Cell& cell, AuditedCell audited, const std::vector<RecordedScene>& scenes)
      : cell_(cell), audited_(std::move(audited)), scenes_(scenes) {}

  // Looks at each change of the scene since the last state, then at the state.
  void go_to(TimePoint time, const Configuration& q) {
    while (report_.states_checked > 0 && next_ < scenes_.size() && scenes_[next_].time < time) {
      const TimePoint change = scenes_[next_].time;
      const double share = to_seconds(change - last_time_) / to_seconds(time - last_time_);
      look_at(change, last_q_ + share * (q - last_q_));
    }
    look_at(time, q);
  }

  [[nodiscard]] AuditReport report() && { return std::move(report_); }

 private:
  void look_at(TimePoint time, const Configuration& q) {
    const bool is_new_scene = change_scene(time);
    const bool is_first = report_.states_checked == 0;
    ++report_.states_checked;
    last_time_ = time;
    if (!is_first && !is_new_scene && q == last_q_) return;  // same result as the last state
    last_q_ = q;
    audited_.move_to(cell_, q);
    for (AuditedPair& pair : audited_.pairs()) {
      const double at_least = audited_.at_least(pair);
      // A pair beyond the smallest clearance so far cannot change the report.
      if (pair.contact_only ? at_least > 0.0 || report_.first_contact.has_value()
                            : at_least >= smallest_m_) {
        continue;
      }
      note(time, pair, audited_.look(pair, pair.contact_only ? 0.0 : smallest_m_));
    }
  }

  // Returns true if another scene holds at this time than at the last call.
  bool change_scene(TimePoint time) {
    const std::size_t before = next_;
    while (next_ < scenes_.size() && scenes_[next_].time <= time) ++next_;
    if (next_ == before) return false;
    audited_.set_scene(cell_, scenes_[next_ - 1]);
    return true;
  }

  void note(TimePoint time, const AuditedPair& pair, double distance_m) {
    const AuditFinding finding{time, audited_.solid(pair.a).name, audited_.solid(pair.b).name,
                               distance_m};
    if (distance_m <= 0.0 && !report_.first_contact) report_.first_contact = finding;
    if (pair.contact_only || distance_m >= smallest_m_) return;
    smallest_m_ = distance_m;
    report_.smallest_clearance = finding;
  }

  const Cell& cell_;
  AuditedCell audited_;
  const std::vector<RecordedScene>& scenes_;
  std::size_t next_ = 0;  // the first scene that does not hold yet
  AuditReport report_;
  TimePoint last_time_{};
  Configuration last_q_;
  double smallest_m_ = std::numeric_limits<double>::infinity();
};

void check_scenes(const Cell& cell, const std::vector<RecordedScene>& scenes) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (i > 0 && scenes[i].time < scenes[i - 1].time) {
      throw std::invalid_argument("audit: times of scenes must not decrease");
    }
    for (const Attachment& held : scenes[i].held) {
      if (held.link.index() < cell.links.size() && cell.link(held.link).arm) continue;
      throw std::invalid_argument("audit: an arm must move the link of a held object");
    }
  }
}

void check_states(const Cell& cell, const std::vector<RecordedState>& states, Duration step) {
  if (step <= Duration::zero()) throw std::invalid_argument("audit: the step must be positive");
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (static_cast<std::size_t>(states[i].q.size()) != cell.joints.size()) {
      throw std::invalid_argument("audit: a state must have one entry per joint of the cell");
    }
    if (i > 0 && states[i].time <= states[i - 1].time) {
      throw std::invalid_argument("audit: times of states must increase");
    }
  }
}

}  // namespace

Result<AuditReport> audit(const Cell& cell, const std::vector<RecordedState>& states, Duration step,
                          const std::vector<RecordedScene>& scenes) {
  check_states(cell, states, step);
  check_scenes(cell, scenes);
  for (const RecordedState& state : states) {
    if (state.q.allFinite()) continue;
    return failure(Problem{ProblemKind::invalid, "not-finite",
                           "t = " + std::to_string(to_seconds(state.time)) + " s",
                           "a recorded position is not a finite number"});
  }
  auto audited = AuditedCell::build(cell);
  if (!audited) return failure(std::move(audited.error()));
  Problems problems;
  for (const RecordedScene& scene : scenes) find_unloaded_meshes(scene, problems);
  if (!problems.empty()) return failure(std::move(problems));

  Audit audit(cell, std::move(*audited), scenes);
  if (!states.empty()) audit.go_to(states.front().time, states.front().q);
  Configuration q;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const RecordedState& from = states[i - 1];
    const RecordedState& to = states[i];
    const Duration gap = to.time - from.time;
    const std::int64_t steps = (gap.count() + step.count() - 1) / step.count();
    for (std::int64_t k = 1; k < steps && !to.after_rest; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(steps);
      q = from.q + share * (to.q - from.q);
      audit.go_to(from.time + Duration{std::llround(share * static_cast<double>(gap.count()))}, q);
    }
    audit.go_to(to.time, to.q);
  }
  return std::move(audit).report();
}

}  // namespace armloom
