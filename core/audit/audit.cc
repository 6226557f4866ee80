#include "core/audit/audit.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "core/audit/audited_cell.h"

namespace armloom {
namespace {

class Audit {
 public:
  Audit(const Cell& cell, AuditedCell audited) : cell_(cell), audited_(std::move(audited)) {}

  void look_at(TimePoint time, const Configuration& q) {
    ++report_.states_checked;
    if (report_.states_checked > 1 && q == last_q_) return;  // same result as the last state
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

  [[nodiscard]] AuditReport report() && { return std::move(report_); }

 private:
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
  AuditReport report_;
  Configuration last_q_;
  double smallest_m_ = std::numeric_limits<double>::infinity();
};

void check_preconditions(const Cell& cell, const std::vector<RecordedState>& states,
                         Duration step) {
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

Result<AuditReport> audit(const Cell& cell, const std::vector<RecordedState>& states,
                          Duration step) {
  check_preconditions(cell, states, step);
  for (const RecordedState& state : states) {
    if (state.q.allFinite()) continue;
    return failure(Problem{ProblemKind::invalid, "not-finite",
                           "t = " + std::to_string(to_seconds(state.time)) + " s",
                           "a recorded position is not a finite number"});
  }
  auto audited = AuditedCell::build(cell);
  if (!audited) return failure(std::move(audited.error()));

  Audit audit(cell, std::move(*audited));
  if (!states.empty()) audit.look_at(states.front().time, states.front().q);
  Configuration q;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const RecordedState& from = states[i - 1];
    const RecordedState& to = states[i];
    const Duration gap = to.time - from.time;
    const std::int64_t steps = (gap.count() + step.count() - 1) / step.count();
    for (std::int64_t k = 1; k < steps && !to.after_rest; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(steps);
      q = from.q + share * (to.q - from.q);
      audit.look_at(from.time + Duration{std::llround(share * static_cast<double>(gap.count()))},
                    q);
    }
    audit.look_at(to.time, to.q);
  }
  return std::move(audit).report();
}

}  // namespace armloom
