#include "core/collision/check/certified_check.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/collision/check/certificates.h"
#include "core/collision/check/motion_checker.h"
#include "core/collision/check/pair_regions.h"
#include "core/coordination/in_step.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Returns the smallest limits of the candidates' pairs, before any pair is allowed to part.
ClearanceBound least_asked(const PlanningScene::Bodies& bodies, const Question& question) {
  const PairLimits limits = PairLimits::of(*bodies.cell);
  ClearanceBound bound{limits.clearance_m, limits.self_clearance_m};
  for (const PairGroup& group : bodies.groups) {
    if (group.kind != PairGroup::Kind::mount) continue;
    for (const Motion& motion : question.candidates) {
      const auto& arms = motion.trajectory->arms();
      if (std::ranges::find(arms, group.arm) == arms.end()) continue;
      bound.apart_m = std::min(bound.apart_m, group.limit_m(limits));
    }
  }
  return bound;
}

}  // namespace

std::uint64_t cell_budget(std::uint64_t cells, double longest_s) {
  return static_cast<std::uint64_t>(static_cast<double>(cells) * std::max(1.0, longest_s / 10.0));
}

double CertifiedCheck::ArmMotion::progress_s() const {
  return motion == nullptr ? 0.0 : std::max(0.0, to_seconds(motion->progress));
}

CertifiedCheck::CertifiedCheck(MotionStore& store, const Question& question)
    : store_(store),
      question_(question),
      tracking_errors_(tracking_errors_of(question.method)),
      verdict_{Verdict::Kind::free,
               question.version,
               {},
               least_asked(store.scene()->bodies(), question),
               0,
               {}} {
  if (static_cast<std::size_t>(question.rest.size()) != store.scene()->cell().joints.size()) {
    throw std::invalid_argument("MotionChecker: rest must have one entry per joint of the cell");
  }
}

std::vector<CertifiedCheck::ArmMotion> CertifiedCheck::arms_of(const Motion& motion) {
  std::vector<ArmMotion> arms;
  for (const ArmId arm : motion.trajectory->arms()) {
    arms.push_back({&motion, &store_.motion(motion.trajectory, arm, question_.rest,
                                            std::max(tracking_errors_.of(arm), motion.off_path))});
  }
  return arms;
}

// Returns the arms of candidates, then those of other motions, then the arms at rest.
std::vector<CertifiedCheck::ArmMotion> CertifiedCheck::all_arms() {
  const Cell& cell = store_.scene()->cell();
  std::vector<bool> moved(cell.arms.size(), false);
  std::vector<ArmMotion> all;
  for (const std::vector<Motion>* motions : {&question_.candidates, &question_.others}) {
    for (const Motion& motion : *motions) {
      for (const ArmMotion& arm : arms_of(motion)) {
        if (moved[arm.entry->arm.index()]) {
          throw std::invalid_argument("MotionChecker: two motions of arm " +
                                      cell.arm(arm.entry->arm).name);
        }
        moved[arm.entry->arm.index()] = true;
        all.push_back(arm);
      }
    }
  }
  for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
    if (moved[a]) continue;
    all.push_back({nullptr, &store_.motion(nullptr, ArmId{a}, question_.rest,
                                           tracking_errors_.of(ArmId{a}))});
  }
  return all;
}

Verdict CertifiedCheck::swept() {
  const std::vector<ArmMotion> all = all_arms();
  std::size_t candidates = 0;
  for (const Motion& motion : question_.candidates) candidates += motion.trajectory->arms().size();
  for (std::size_t own = 0; own < candidates; ++own) {
    check_alone(all[own]);
    for (std::size_t other = own + 1; other < all.size(); ++other) {
      const bool is_one_motion = all[own].motion == all[other].motion;
      is_one_motion ? check_in_step(all[own], all[other]) : check_swept(all[own], all[other]);
    }
  }
  if (verdict_.kind != Verdict::Kind::free) {
    verdict_.clearance_bound.reset();
    return std::move(verdict_);
  }
  certify_alone();
  certify_swept(all, candidates);
  return std::move(verdict_);
}

// Adds certificates for each candidate against itself and static bodies, and against arms out of
// its reach.
void CertifiedCheck::certify_alone() {
  const PlanningScene& scene = *store_.scene();
  const SceneFingerprint& content = scene.fingerprint();
  for (const Motion& motion : question_.candidates) {
    std::vector<MotionStore::Entry*> entries;
    for (const ArmMotion& arm : arms_of(motion)) entries.push_back(arm.entry);
    const CertifiedSide side = certified_side(entries, &motion);
    SceneCertificate& alone = std::get<SceneCertificate>(
        verdict_.certificates.emplace_back(SceneCertificate{side, {}, content.of(side.arms)}));
    for (const ArmId arm : side.arms) alone.objects.push_back(content.objects[arm.index()]);
    if (entries.size() > 1) {
      Duration reach = motion.trajectory->duration();
      for (MotionStore::Entry* arm : entries) {
        reach = std::min(reach, from_seconds(store_.stopping_reach_s(*arm)));
      }
      verdict_.certificates.emplace_back(TogetherCertificate{
          side, lead_max(scene.cell(), *motion.trajectory) + reach, content.of(side.arms)});
    }
    for (const ArmId own : side.arms) {
      for (std::uint32_t a = 0; a < scene.cell().arms.size(); ++a) {
        const ArmId other{a}, first = std::min(own, other), second = std::max(own, other);
        if (first == second || !store_.out_of_reach(first, second)) continue;
        verdict_.certificates.emplace_back(
            ApartCertificate{first, second, content.of({&first, 1}, {&second, 1})});
      }
    }
  }
}

// Adds certificates for all that remains of each candidate, against every other motion and every
// arm at rest.
void CertifiedCheck::certify_swept(const std::vector<ArmMotion>& all, std::size_t candidates) {
  struct Side {
    const Motion* motion;
    CertifiedSide certified;
  };
  std::vector<Side> sides;
  std::size_t of_candidates = 0;
  for (std::size_t i = 0; i < all.size();) {
    std::vector<MotionStore::Entry*> entries{all[i].entry};
    const Motion* motion = all[i].motion;
    for (++i; motion != nullptr && i < all.size() && all[i].motion == motion; ++i) {
      entries.push_back(all[i].entry);
    }
    sides.push_back({motion, certified_side(entries, motion)});
    if (i <= candidates) of_candidates = sides.size();
  }
  for (std::size_t own = 0; own < of_candidates; ++own) {
    for (std::size_t other = own + 1; other < sides.size(); ++other) {
      verdict_.certificates.emplace_back(
          pair_certificate(*store_.scene(), sides[own].certified, sides[other].certified, {}));
    }
  }
}

// Checks each candidate by itself first, then finds the regions of the pairs.
Verdict CertifiedCheck::coordinated() {
  for (const Motion& motion : question_.candidates) {
    if (store_.is_interrupted()) break;
    const std::vector<ArmMotion> arms = arms_of(motion);
    for (auto own = arms.begin(); own != arms.end(); ++own) {
      check_alone(*own);
      for (auto other = own + 1; other != arms.end(); ++other) check_in_step(*own, *other);
    }
  }
  if (verdict_.kind != Verdict::Kind::free) {
    verdict_.clearance_bound.reset();
    return std::move(verdict_);
  }
  PairRegionSearch search(store_, question_);
  verdict_.regions = search.find();
  verdict_.evaluations += search.evaluations();
  verdict_.clearance_bound->lower(search.parted());
  verdict_.exhausted = search.exhausted();
  verdict_.certificates = search.take_certificates();
  certify_alone();
  return std::move(verdict_);
}

void CertifiedCheck::check_alone(const ArmMotion& own) {
  const ProgressBand all{.progress_a = own.progress_s(),
                         .duration_a = to_seconds(own.entry->duration())};
  ask(store_.with_itself(*own.entry), all, own, nullptr);
  ask(store_.with_still(*own.entry), all, own, nullptr);
}

void CertifiedCheck::check_swept(const ArmMotion& own, const ArmMotion& other) {
  ask(store_.between(*own.entry, *other.entry),
      {.progress_a = own.progress_s(),
       .progress_b = other.progress_s(),
       .duration_a = to_seconds(own.entry->duration()),
       .duration_b = to_seconds(other.entry->duration()),
       .swept = true},
      own, &other);
}

// Checks two arms of one synchronous motion. Each arm may be as far behind the other as in_step.h
// permits.
void CertifiedCheck::check_in_step(const ArmMotion& own, const ArmMotion& other) {
  const double apart_s = to_seconds(lead_max(store_.scene()->cell(), *own.motion->trajectory));
  const double duration_s = to_seconds(own.entry->duration());
  ask(store_.between(*own.entry, *other.entry),
      {.progress_a = own.progress_s(),
       .progress_b = own.progress_s(),
       .lag_a = apart_s + store_.stopping_reach_s(*other.entry),
       .lag_b = apart_s + store_.stopping_reach_s(*own.entry),
       .duration_a = duration_s,
       .duration_b = duration_s},
      own, &other);
}

OrientedDiagram CertifiedCheck::parting_of(const OrientedDiagram& diagram,
                                           const ProgressBand& band) const {
  if (!question_.may_part) return {};
  return diagram.parting_at(from_seconds(band.progress_a), from_seconds(band.progress_b));
}

void CertifiedCheck::ask(const OrientedDiagram& diagram, const ProgressBand& band,
                         const ArmMotion& own, const ArmMotion* other) {
  if (!diagram) return;
  const std::uint64_t budget = cell_budget(MotionChecker::kBudget * question_.effort,
                                           std::max(band.duration_a, band.duration_b));
  CoordinationDiagram::Answer answer = diagram.ask(band, budget);
  verdict_.evaluations += answer.evaluations;
  if (answer.free) return;
  if (const auto parting = parting_of(diagram, band)) {
    answer = parting.ask(band, budget);
    verdict_.evaluations += answer.evaluations;
    if (answer.free) {  // certified with the smaller limits of parting pairs
      parting.lower(*verdict_.clearance_bound);
      return;
    }
  }
  report(answer, diagram, own, other);
}

void CertifiedCheck::report(const CoordinationDiagram::Answer& answer,
                            const OrientedDiagram& diagram, const ArmMotion& own,
                            const ArmMotion* other) {
  verdict_.exhausted = verdict_.exhausted || (answer.exhausted && !answer.proven);
  if (answer.proven) {
    verdict_.kind = Verdict::Kind::conflict;
  } else if (verdict_.kind == Verdict::Kind::free) {
    verdict_.kind = Verdict::Kind::undecided;
  }
  const CoordinationDiagram::Witness& found = *answer.conflict;
  Conflict conflict{Conflict::With::scene,       own.motion->step, std::nullopt,
                    diagram.proximity_of(found), found.time_a,     found.time_b};
  if (diagram.is_self(found) || (other != nullptr && other->motion == own.motion)) {
    conflict.with = Conflict::With::self;
  } else if (other != nullptr && other->motion != nullptr) {
    conflict.with = Conflict::With::motion;
    conflict.other_step = other->motion->step;
  } else if (other != nullptr) {
    conflict.with = Conflict::With::rest;
  }
  verdict_.conflicts.push_back(std::move(conflict));
}

void check_passage(MotionStore& store, const PassageQuestion& passage, Configuration rest,
                   const TrackingErrors& tracking_errors, Verdict& verdict) {
  PassageAnswer& is = verdict.passages.emplace_back(PassageAnswer::free);
  std::optional<PassageBlock>& block = verdict.passage_blocks.emplace_back();
  const auto& arms = passage.motion.trajectory->arms();
  if (std::ranges::all_of(arms, [&](ArmId a) { return store.out_of_reach(a, passage.arm); })) {
    is = PassageAnswer::apart;
    return;
  }
  const auto& joints = store.scene()->cell().arm(passage.arm).joints;
  Configuration at_rest = rest;
  set_joints(at_rest, joints, passage.rest);
  MotionStore::Entry& other =
      store.motion(nullptr, passage.arm, at_rest, tracking_errors.of(passage.arm));
  for (const ArmId arm : arms) {
    MotionStore::Entry& own =
        store.motion(passage.motion.trajectory, arm, rest, tracking_errors.of(arm));
    const OrientedDiagram diagram = store.between(own, other);
    if (!diagram) continue;
    const double duration_s = to_seconds(own.duration());
    const CoordinationDiagram::Answer answer = diagram.ask(
        {.duration_a = duration_s, .swept = true}, cell_budget(MotionChecker::kBudget, duration_s));
    verdict.evaluations += answer.evaluations;
    if (answer.free) continue;
    is = PassageAnswer::blocked;
    block = PassageBlock{diagram.proximity_of(*answer.conflict), answer.conflict->time_a};
    return;
  }
}

}  // namespace armloom
