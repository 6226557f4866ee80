#include "core/jobs/step_facts.h"

#include <algorithm>
#include <memory>

namespace armloom {

const Step* StepFacts::find(StepId step) const {
  const auto it = steps_.find(step);
  return it == steps_.end() ? nullptr : &it->second;
}

void StepFacts::set_waits(const Step& step, std::span<const Wait> waits) {
  if (std::ranges::equal(step.waits_on, waits)) return;
  auto& old = edit(step).waits_on;
  const bool same =
      std::ranges::equal(old, waits, [](const Wait& a, const Wait& b) { return a.same_cause(b); });
  old.assign(waits.begin(), waits.end());
  if (!same) changed(step);
}

void StepFacts::set(const Step& step, const Moving& data) {
  if (step.in<Moving>()->pause.has_value() != data.pause.has_value()) changed(step);
  std::get<Moving>(edit(step).phase) = data;
}

void StepFacts::set(const Step& step, Judgement found) {
  Step& own = edit(step);
  auto* held = std::get_if<Held>(&own.phase);
  (held != nullptr ? held->judgement : std::get<Queued>(own.phase).judgement) = std::move(found);
}

void StepFacts::set(const Step& step, std::optional<Pause> pause) {
  Step& own = edit(step);
  if (auto* held = std::get_if<Held>(&own.phase)) {
    held->pause = pause.value();
    return;
  }
  auto* moving = std::get_if<Moving>(&own.phase);
  auto& old = moving != nullptr ? moving->pause : std::get<Admitted>(own.phase).pause;
  if (old.has_value() != pause.has_value()) changed(step);
  old = pause;
}

void StepFacts::set(const Step& step, std::optional<Detour> fact) {
  Step& own = explained(step);
  if (!fact) own.plans.drop(ForDetour{});
  own.goal->detour = std::move(fact);
}

void StepFacts::set(const Step& step, AnotherWay fact) {
  if (step.is_replanned_now() != fact.is_open) changed(step);
  fact.is_open ? (void)being_replanned_.insert(step.id.job)
               : (void)being_replanned_.erase(step.id.job);
  explained(step).another_way = std::move(fact);
}

void StepFacts::set(const Step& step, Job fact) {
  if (fact.ring != step.job->ring) changed(step);
  edit(step).job = std::make_shared<Job>(std::move(fact));
}

void StepFacts::put_in_question(const Step& step) {
  edit(step).asking.is_in_question = true;
  ++changes_;
}

}  // namespace armloom
