#include "core/collision/arbiter.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "core/collision/joined_cells.h"
#include "core/collision/judge.h"
#include "core/collision/motion_store.h"
#include "core/collision/pair_regions.h"
#include "core/collision/parting.h"
#include "core/coordination/in_step.h"

namespace armloom {
namespace {

// How the two motions of a pair may be off their plans, by the question's method.
struct Freedom {
  double lag_s = 0.0;
  double reaction_s = 0.0;
  bool stopping = false;
  bool swept = false;
  double tracking_error = 0.0;
};

Freedom freedom_of(const CheckMethod& method, const Cell& cell) {
  if (const auto* swept = std::get_if<Swept>(&method)) {
    return {.swept = true, .tracking_error = swept->tracking_error};
  }
  if (const auto* coordinated = std::get_if<Coordinated>(&method)) {
    return {.tracking_error = coordinated->tracking_error};
  }
  const auto& certified = std::get<Certified>(method);
  return {.lag_s = to_seconds(certified.lag),
          .reaction_s = to_seconds(cell.monitor.reaction),
          .stopping = certified.stopping,
          .tracking_error = certified.tracking_error};
}

// One arm of a motion, or an arm at rest.
struct Mover {
  ArmId arm;
  const Motion* motion;  // null: at rest
  MotionStore::Entry* entry;
};

}  // namespace

class Arbiter::Impl {
 public:
  explicit Impl(PlanningScenePtr scene) : store_(std::move(scene)), checker_(store_.scene()) {}

  void look_at(PlanningScenePtr scene) {
    if (scene == store_.scene()) return;
    if (&scene->cell() != &store_.scene()->cell()) {
      store_ = MotionStore(std::move(scene));
    } else {
      store_.look_at(std::move(scene));
    }
    checker_ = CollisionChecker(store_.scene());
  }

  [[nodiscard]] const PlanningScenePtr& scene() const { return store_.scene(); }

  Verdict judge(const Question& question) {
    const Cell& cell = store_.scene()->cell();
    if (std::holds_alternative<TimedDiscrete>(question.method)) {
      verdict_ = armloom::judge(question, checker_);
      freedom_ = {.swept = true};
      if (!question.passages.empty()) store_.begin_question();
      answer_passages(question);
      return std::move(verdict_);
    }
    if (static_cast<std::size_t>(question.rest.size()) != cell.joints.size()) {
      throw std::invalid_argument("Arbiter: rest must have one entry per joint of the cell");
    }
    freedom_ = freedom_of(question.method, cell);
    budget_ = kBudget * question.effort;
    verdict_ = {Verdict::Kind::free, question.version, {}, least_asked_m(question), 0, {}};
    store_.begin_question();
    if (std::holds_alternative<Coordinated>(question.method)) {
      coordinate(question);
      answer_passages(question);
      return std::move(verdict_);
    }
    gather(question);
    const auto candidates = std::partition_point(parts_.begin(), parts_.end(), [&](const Mover& p) {
      return p.motion != nullptr && is_candidate(question, p.motion);
    });
    for (auto own = parts_.begin(); own != candidates; ++own) {
      ask_alone(*own);
      for (auto other = own + 1; other != parts_.end(); ++other) ask_pair(*own, *other);
    }
    if (verdict_.kind != Verdict::Kind::free) {
      verdict_.clearance_bound_m.reset();
      if (question.find_earliest) find_earliest(candidates - parts_.begin());
    }
    answer_passages(question);
    return std::move(verdict_);
  }

  Diagram draw(const TrajectoryPtr& a, const TrajectoryPtr& b, const Configuration& rest,
               double tracking_error, Duration resolution, std::uint64_t budget) {
    store_.begin_question();
    Diagram diagram{a->duration(), b->duration(), {}, 0};
    for (const ArmId arm_a : a->arms()) {
      for (const ArmId arm_b : b->arms()) {
        if (arm_a == arm_b) continue;
        diagram.layers.push_back({arm_a, arm_b, {}});
        auto& own = store_.motion(a, arm_a, rest, tracking_error);
        auto& other = store_.motion(b, arm_b, rest, tracking_error);
        draw(own, other, resolution, budget, diagram);
      }
    }
    return diagram;
  }

 private:
  void draw(MotionStore::Entry& own, MotionStore::Entry& other, Duration resolution,
            std::uint64_t budget, Diagram& diagram) {
    std::vector<DiagramCell>& cells = diagram.layers.back().cells;
    if (store_.out_of_reach(own.arm, other.arm)) {
      cells.push_back({Duration{}, diagram.duration_a, Duration{}, diagram.duration_b,
                       DiagramCell::State::free});
      return;
    }
    const bool turned = other.arm < own.arm;
    CoordinationDiagram& pair = *(turned ? store_.pair(other, own) : store_.pair(own, other)).cells;
    constexpr double kAll = Region::kUnbounded;
    const double duration_a = to_seconds(turned ? diagram.duration_b : diagram.duration_a);
    const double duration_b = to_seconds(turned ? diagram.duration_a : diagram.duration_b);
    diagram.evaluations +=
        pair.refine({0.0, 0.0, kAll, kAll, kAll, kAll, duration_a, duration_b}, resolution, budget);
    for (const CoordinationDiagram::CellView& cell : pair.cells()) {
      using From = CoordinationDiagram::CellState;
      const auto state = cell.state == From::free       ? DiagramCell::State::free
                         : cell.state == From::conflict ? DiagramCell::State::conflict
                                                        : DiagramCell::State::undecided;
      if (turned) {
        cells.push_back({cell.from_b, cell.to_b, cell.from_a, cell.to_a, state});
      } else {
        cells.push_back({cell.from_a, cell.to_a, cell.from_b, cell.to_b, state});
      }
    }
    cells = joined(std::move(cells), diagram);
  }

  // Of every pair of a candidate with another arm or what stands still.
  [[nodiscard]] double least_asked_m(const Question& question) const {
    const PlanningScene::Bodies& bodies = store_.scene()->bodies();
    double least_m = bodies.cell->clearance_m;
    for (const PairGroup& group : bodies.groups) {
      if (group.kind != PairGroup::Kind::mount) continue;
      for (const Motion& motion : question.candidates) {
        if (std::ranges::find(motion.trajectory->arms(), group.arm) ==
            motion.trajectory->arms().end()) {
          continue;
        }
        least_m = std::min(least_m, group.limit_m(PairLimits::of(*bodies.cell)));
      }
    }
    return least_m;
  }

  static bool is_candidate(const Question& question, const Motion* motion) {
    return !question.candidates.empty() && motion >= question.candidates.data() &&
           motion < question.candidates.data() + question.candidates.size();
  }

  // Each candidate by itself, as its plan has it; only then the regions of the pairs.
  void coordinate(const Question& question) {
    for (const Motion& motion : question.candidates) {
      parts_.clear();
      for (const ArmId arm : motion.trajectory->arms())
        parts_.push_back(part_of(question, motion, arm));
      for (auto own = parts_.begin(); own != parts_.end(); ++own) {
        ask_alone(*own);
        for (auto other = own + 1; other != parts_.end(); ++other) ask_in_step(*own, *other);
      }
    }
    if (verdict_.kind != Verdict::Kind::free) {
      verdict_.clearance_bound_m.reset();
      return;
    }
    PairRegionSearch search(store_, question);
    verdict_.regions = search.find();
    verdict_.evaluations += search.evaluations();
    verdict_.clearance_bound_m = std::min(*verdict_.clearance_bound_m, search.least_limit_m());
    verdict_.exhausted = search.exhausted();
  }

  void answer_passages(const Question& question) {
    for (const PassageQuestion& passage : question.passages) {
      verdict_.passages.push_back(answer(question, passage));
    }
  }

  [[nodiscard]] PassageAnswer answer(const Question& question, const PassageQuestion& passage) {
    const auto& arms = passage.motion.trajectory->arms();
    if (std::ranges::all_of(arms, [&](ArmId a) { return store_.out_of_reach(a, passage.arm); })) {
      return PassageAnswer::apart;
    }
    Configuration rest = question.rest;
    const auto& joints = store_.scene()->cell().arm(passage.arm).joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      rest[static_cast<Eigen::Index>(joints[j].index())] =
          passage.rest[static_cast<Eigen::Index>(j)];
    }
    bool free = true;
    if (std::holds_alternative<Coordinated>(question.method)) {
      PairRegionSearch search(store_, question);
      free = search.passes(passage.motion, passage.arm, rest);
      verdict_.evaluations += search.evaluations();
    } else {
      const Mover other{passage.arm, nullptr,
                        &store_.motion(nullptr, passage.arm, rest, freedom_.tracking_error)};
      free = std::ranges::all_of(
          arms, [&](ArmId arm) { return is_free(part_of(question, passage.motion, arm), other); });
    }
    return free ? PassageAnswer::free : PassageAnswer::blocked;
  }

  [[nodiscard]] bool is_free(const Mover& own, const Mover& other) {
    if (store_.out_of_reach(own.arm, other.arm)) return true;
    const bool turned = other.arm < own.arm;
    const Mover& a = turned ? other : own;
    const Mover& b = turned ? own : other;
    const MotionStore::Diagram diagram = store_.pair(*a.entry, *b.entry);
    if (diagram.pairs->empty()) return true;
    const Region region = region_of(a, b);
    const double longest_s = std::max(region.duration_a, region.duration_b);
    const auto budget = static_cast<std::uint64_t>(kBudget * std::max(1.0, longest_s / 10.0));
    const CoordinationDiagram::Answer answer = diagram.cells->ask(region, budget);
    verdict_.evaluations += answer.evaluations;
    return answer.free;
  }

  // Arms of candidates, of others, and those at rest, in this order.
  void gather(const Question& question) {
    const Cell& cell = store_.scene()->cell();
    std::vector<bool> moved(cell.arms.size(), false);
    parts_.clear();
    const auto add = [&](const Motion& motion) {
      for (const ArmId arm : motion.trajectory->arms()) {
        if (moved[arm.index()]) {
          throw std::invalid_argument("Arbiter: two motions of arm " + cell.arm(arm).name);
        }
        moved[arm.index()] = true;
        parts_.push_back(part_of(question, motion, arm));
      }
    };
    for (const Motion& motion : question.candidates) add(motion);
    for (const Motion& motion : question.others) add(motion);
    for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
      if (moved[a]) continue;
      parts_.push_back({ArmId{a}, nullptr,
                        &store_.motion(nullptr, ArmId{a}, question.rest, freedom_.tracking_error)});
    }
  }

  [[nodiscard]] Mover part_of(const Question& question, const Motion& motion, ArmId arm) {
    return {arm, &motion,
            &store_.motion(motion.trajectory, arm, question.rest, freedom_.tracking_error)};
  }

  [[nodiscard]] double lead_of(const Mover& part) const {
    if (freedom_.swept) return Region::kUnbounded;
    if (!freedom_.stopping || part.motion == nullptr) return 0.0;
    return freedom_.reaction_s + part.entry->stopping_reach_s;
  }
  [[nodiscard]] double lag_of(const Mover& part) const {
    if (freedom_.swept) return Region::kUnbounded;
    if (part.motion == nullptr) return 0.0;
    return part.motion->may_stand ? Region::kUnbounded : freedom_.lag_s;
  }
  [[nodiscard]] static double progress_of(const Mover& part) {
    return part.motion == nullptr ? 0.0 : to_seconds(part.motion->progress);
  }

  [[nodiscard]] static double proven_of(const Mover& mover) {
    const bool extrapolated = mover.motion != nullptr && mover.motion->proven;
    return extrapolated ? to_seconds(*mover.motion->proven) : Region::kUnbounded;
  }

  [[nodiscard]] Region region_of(const Mover& a, const Mover& b) const {
    return {.progress_a = progress_of(a),
            .progress_b = progress_of(b),
            .lag_a = lag_of(a),
            .lag_b = lag_of(b),
            .lead_a = lead_of(a),
            .lead_b = lead_of(b),
            .duration_a = to_seconds(a.entry->tube->duration()),
            .duration_b = to_seconds(b.entry->tube->duration()),
            .proven_a = proven_of(a),
            .proven_b = proven_of(b)};
  }

  // The smallest shift of all candidates that is free, if what is in the way moves out of it.
  void find_earliest(std::ptrdiff_t candidates) {
    const bool waits_for_motions = std::ranges::all_of(
        verdict_.conflicts,
        [](const Conflict& conflict) { return conflict.with == Conflict::With::motion; });
    const auto own_end = parts_.begin() + candidates;
    const bool not_begun = std::all_of(parts_.begin(), own_end, [](const Mover& mover) {
      return mover.motion->progress <= Duration{};
    });
    if (!waits_for_motions || !not_begun) return;
    double shift_s = 0.0;
    for (bool moved = true; moved;) {
      moved = false;
      for (auto own = parts_.begin(); own != own_end; ++own) {
        for (auto other = own_end; other != parts_.end(); ++other) {
          const auto next = next_free_shift(*own, *other, shift_s);
          if (!next) return;
          moved = moved || *next > shift_s;
          shift_s = *next;
        }
      }
    }
    verdict_.earliest_start = from_seconds(shift_s);
  }

  // The first shift from `shift_s` on, in growing steps, at which this pair is free. A conflict at
  // (ta, tb) is in the region of every shift up to
  //   tb - progress_b + lag_b - (ta - lead_a):
  // so much later the other one has left tb for good when the candidate may come to ta. Where the
  // other one rests, it never leaves.
  std::optional<double> next_free_shift(const Mover& own, const Mover& other, double shift_s) {
    if (store_.out_of_reach(own.arm, other.arm)) return shift_s;
    const bool turned = other.arm < own.arm;
    const MotionStore::Diagram diagram =
        turned ? store_.pair(*other.entry, *own.entry) : store_.pair(*own.entry, *other.entry);
    if (diagram.pairs->empty()) return shift_s;
    const double end_s = other.motion == nullptr ? 0.0 : to_seconds(other.motion->remaining());
    const auto ask_at = [&](double shift) {
      Region region = turned ? region_of(other, own) : region_of(own, other);
      (turned ? region.progress_b : region.progress_a) -= shift;
      CoordinationDiagram::Answer answer = diagram.cells->ask(region, budget_);
      verdict_.evaluations += answer.evaluations;
      verdict_.exhausted = verdict_.exhausted || (answer.exhausted && !answer.proven);
      return answer;
    };
    std::optional<double> blocked_s;  // the last shift that is known not to be free
    for (double step_s = kShift_s;; step_s = std::min(2.0 * step_s, kWindow_s)) {
      const CoordinationDiagram::Answer answer = ask_at(shift_s);
      if (answer.free) break;
      if (shift_s > end_s + kShift_s) return std::nullopt;  // it has come to rest in the way
      const CoordinationDiagram::Finding& found = *answer.conflict;
      const double own_s = to_seconds(turned ? found.time_b : found.time_a);
      const double other_s = to_seconds(turned ? found.time_a : found.time_b);
      const double clear_s = other_s - progress_of(other) + std::min(lag_of(other), end_s) -
                             std::max(0.0, own_s - lead_of(own)) + progress_of(own);
      blocked_s = std::max(shift_s, std::min(clear_s, end_s + kShift_s));
      shift_s = *blocked_s + step_s;
    }
    if (!blocked_s) return shift_s;
    while (shift_s - *blocked_s > kShift_s) {
      const double middle_s = 0.5 * (shift_s + *blocked_s);
      (ask_at(middle_s).free ? shift_s : *blocked_s) = middle_s;
    }
    return shift_s;
  }

  void ask_alone(const Mover& own) {
    const Region region{.progress_a = std::max(progress_of(own), 0.0),
                        .duration_a = to_seconds(own.entry->tube->duration())};
    ask(store_.self(*own.entry), region, own, nullptr, false);
    ask(store_.still(*own.entry), region, own, nullptr, false);
  }

  void ask_pair(const Mover& own, const Mover& other) {
    if (store_.out_of_reach(own.arm, other.arm)) return;
    const bool turned = other.arm < own.arm;
    const Mover& a = turned ? other : own;
    const Mover& b = turned ? own : other;
    ask(store_.pair(*a.entry, *b.entry), region_of(a, b), own, &other, turned);
  }

  // Two arms of one synchronous motion: side by side, or one of them as far behind as it can get.
  void ask_in_step(const Mover& own, const Mover& other) {
    if (store_.out_of_reach(own.arm, other.arm)) return;
    const bool turned = other.arm < own.arm;
    const Mover& a = turned ? other : own;
    const Mover& b = turned ? own : other;
    const double progress = std::max(progress_of(own), 0.0);
    const double duration = to_seconds(own.entry->tube->duration());
    const double apart_s = to_seconds(kOutOfStep + kUntilTold);
    const Region band{.progress_a = progress,
                      .progress_b = progress,
                      .lag_a = apart_s + b.entry->stopping_reach_s,
                      .lag_b = apart_s + a.entry->stopping_reach_s,
                      .duration_a = duration,
                      .duration_b = duration};
    ask(store_.pair(*a.entry, *b.entry), band, own, &other, turned);
  }

  void ask(const MotionStore::Diagram& diagram, const Region& region, const Mover& own,
           const Mover* other, bool turned) {
    if (diagram.pairs->empty()) return;
    const double longest_s = std::max(region.duration_a, region.duration_b);
    const auto budget =
        static_cast<std::uint64_t>(static_cast<double>(budget_) * std::max(1.0, longest_s / 10.0));
    CoordinationDiagram::Answer answer = diagram.cells->ask(region, budget);
    verdict_.evaluations += answer.evaluations;
    if (answer.free) return;
    const auto time = [](double progress) { return std::max(from_seconds(progress), Duration{}); };
    const auto close =
        diagram.cells->too_close_at(time(region.progress_a), time(region.progress_b));
    if (!close.empty()) {
      const PairSet parting = held_to_less(*diagram.pairs, close, kPartingShare);
      CoordinationDiagram alone = store_.with_pairs(diagram, parting);
      answer = alone.ask(region, budget);
      verdict_.evaluations += answer.evaluations;
      if (answer.free) return keep(*diagram.bodies, parting);
    }
    report(answer, *diagram.bodies, own, other, turned);
  }

  // Pairs that are held to less: that is what is proven.
  void keep(const PlanningScene::Bodies& bodies, const PairSet& pairs) {
    verdict_.clearance_bound_m = least_limit_m(bodies, pairs, *verdict_.clearance_bound_m);
  }

  void report(const CoordinationDiagram::Answer& answer, const PlanningScene::Bodies& bodies,
              const Mover& own, const Mover* other, bool turned) {
    verdict_.exhausted = verdict_.exhausted || (answer.exhausted && !answer.proven);
    if (answer.proven) {
      verdict_.kind = Verdict::Kind::conflict;
    } else if (verdict_.kind == Verdict::Kind::free) {
      verdict_.kind = Verdict::Kind::undecided;
    }
    const CoordinationDiagram::Finding& found = *answer.conflict;
    const PartPair& pair = bodies.pairs[found.pair.index()];
    const auto& a = bodies.parts[pair.a];
    const auto& b = bodies.parts[pair.b];
    Conflict conflict{Conflict::With::scene,
                      own.motion->job,
                      std::nullopt,
                      proximity_of(a, b, found.distance_m),
                      turned ? found.time_b : found.time_a,
                      turned ? found.time_a : found.time_b};
    if (turned) conflict.proximity = turned_around(std::move(conflict.proximity));
    if (other == nullptr) {
      const bool itself = bodies.group_of(found.pair).kind == PairGroup::Kind::self;
      if (itself) conflict.with = Conflict::With::self;
    } else if (other->motion == own.motion) {
      conflict.with = Conflict::With::self;
    } else if (other->motion != nullptr) {
      conflict.with = Conflict::With::motion;
      conflict.other_job = other->motion->job;
    } else {
      conflict.with = Conflict::With::rest;
    }
    verdict_.conflicts.push_back(std::move(conflict));
  }

  MotionStore store_;
  CollisionChecker checker_;
  Freedom freedom_;
  std::uint64_t budget_ = kBudget;  // of one pair of motions up to 10 s
  Verdict verdict_{Verdict::Kind::free, 0, {}, {}, 0, {}};
  std::vector<Mover> parts_;
};

Arbiter::Arbiter(PlanningScenePtr scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
Arbiter::~Arbiter() = default;
Arbiter::Arbiter(Arbiter&&) noexcept = default;
Arbiter& Arbiter::operator=(Arbiter&&) noexcept = default;

void Arbiter::look_at(PlanningScenePtr scene) { impl_->look_at(std::move(scene)); }
const PlanningScenePtr& Arbiter::scene() const { return impl_->scene(); }
Verdict Arbiter::judge(const Question& question) { return impl_->judge(question); }
Diagram Arbiter::draw(const TrajectoryPtr& a, const TrajectoryPtr& b, const Configuration& rest,
                      double tracking_error, Duration resolution, std::uint64_t budget) {
  return impl_->draw(a, b, rest, tracking_error, resolution, budget);
}

}  // namespace armloom
