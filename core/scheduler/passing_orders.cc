#include "core/scheduler/passing_orders.h"

#include <algorithm>
#include <map>
#include <utility>

namespace armloom {
namespace {

constexpr double kWeightOfSum = 3.0;  // of the sum over arms, beside the last one's end
constexpr int kPasses = 3;            // of changing single choices
constexpr std::size_t kFreeMax = 24;  // choices that are changed at all

// One region of two motions, and who may go first in it.
struct Decision {
  std::size_t a;
  std::size_t b;
  ConflictRegion region;
  bool a_may = true;
  bool b_may = true;
  bool prefers_a = true;  // of two that are as good
};

// Decisions that are one: all take the same side, or the other one where `turned`.
struct Choice {
  struct Member {
    std::size_t decision;
    bool turned;
  };
  std::vector<Member> members;
  std::vector<bool> options;  // values of "a goes first" of the first member
  bool value = true;
};

bool overlap(Duration from_1, Duration to_1, Duration from_2, Duration to_2) {
  return from_1 <= to_2 && from_2 <= to_1;
}

class Search {
 public:
  Search(const std::vector<CoordinatedMotion>& admitted, const std::vector<Precedence>& precedences,
         const std::vector<CoordinatedMotion>& candidates, const std::vector<Duration>& work_behind)
      : motions_(admitted), first_candidate_(admitted.size()), work_behind_(work_behind) {
    motions_.insert(motions_.end(), candidates.begin(), candidates.end());
    link_arms();
    for (const Precedence& precedence : precedences) add_decided(precedence);
    decided_ = decisions_.size();
  }

  PassingOrders run(const std::vector<PairRegions>& regions) {
    for (const PairRegions& pair : regions) add(pair);
    tie_chains();
    collect_choices();
    if (answer_.obstacles.empty()) {
      search();
      if (!best_prediction_.stuck.empty()) report_ring();
    }
    answer_.prediction = std::move(best_prediction_);
    std::ranges::sort(answer_.in_the_way);
    answer_.in_the_way.erase(std::ranges::unique(answer_.in_the_way).begin(),
                             answer_.in_the_way.end());
    if (!answer_.obstacles.empty()) return std::move(answer_);
    for (std::size_t d = 0; d < decisions_.size(); ++d) {
      answer_.precedences.push_back(std::move(ordered_[d][first_[d] ? 0 : 1]));
    }
    return std::move(answer_);
  }

 private:
  [[nodiscard]] std::optional<std::size_t> index_of(JobId job) const {
    const auto found = std::ranges::find(motions_, job, &CoordinatedMotion::job);
    if (found == motions_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - motions_.begin());
  }

  void link_arms() {
    std::map<ArmId, std::size_t> last;
    before_.resize(motions_.size());
    stands_.assign(motions_.size(), true);
    followed_.assign(motions_.size(), 0);
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      std::size_t preceded = 0;
      for (const ArmId arm : motions_[m].arms) {
        const auto ahead = last.find(arm);
        if (ahead != last.end()) {
          ++preceded;
          ++followed_[ahead->second];
          if (std::ranges::find(before_[m], ahead->second) == before_[m].end()) {
            before_[m].push_back(ahead->second);
          }
        }
        last[arm] = m;
      }
      stands_[m] = preceded < motions_[m].arms.size();
    }
  }

  // Whether each of its arms moves on from its goal.
  [[nodiscard]] bool moves_on(std::size_t m) const {
    return followed_[m] == motions_[m].arms.size();
  }

  // ---- What may be decided ----

  void add(const PairRegions& pair) {
    const std::size_t a = *index_of(pair.a);
    if (const auto* arm = std::get_if<ArmId>(&pair.b)) {
      for (const ConflictRegion& region : pair.regions) {
        answer_.obstacles.push_back(
            {pair.a, std::nullopt, *arm, region.proximity, region.time_a, region.time_b});
        answer_.in_the_way.push_back(*arm);
      }
      return;
    }
    const auto b = index_of(std::get<JobId>(pair.b));
    if (!b) return;  // has ended meanwhile
    for (const ConflictRegion& region : pair.regions) add(a, *b, region);
  }

  // It may be turned as long as the first one has no authority in it.
  void add_decided(const Precedence& precedence) {
    const std::size_t a = *index_of(precedence.first());
    const std::size_t b = *index_of(precedence.second());
    Decision decision{.a = a, .b = b, .region = precedence.region()};
    for (const ProgressBox& box : decision.region.boxes) {
      if (is_behind(motions_[b], box.to_b)) continue;
      if (reaches(a, box.from_a, b) || blocks_end(b, box.to_b, a)) decision.b_may = false;
    }
    if (motions_[a].keeps_its_place && !motions_[b].keeps_its_place) decision.b_may = false;
    decisions_.push_back(std::move(decision));
  }

  void add(std::size_t a, std::size_t b, const ConflictRegion& region) {
    Decision decision{.a = a, .b = b, .region = region, .prefers_a = a < b};
    std::erase_if(decision.region.boxes, [&](const ProgressBox& box) {
      return is_behind(motions_[a], box.to_a) || is_behind(motions_[b], box.to_b);
    });
    if (decision.region.boxes.empty()) return;
    for (const ProgressBox& box : decision.region.boxes) {
      if (reaches(b, box.from_b, a) || blocks_end(a, box.to_a, b)) decision.a_may = false;
      if (reaches(a, box.from_a, b) || blocks_end(b, box.to_b, a)) decision.b_may = false;
      if (blocks_end(a, box.to_a, b)) note_in_the_way(a);
      if (blocks_end(b, box.to_b, a)) note_in_the_way(b);
    }
    if (decision.a_may && decision.b_may) {
      if (motions_[a].keeps_its_place && !motions_[b].keeps_its_place) decision.b_may = false;
      if (motions_[b].keeps_its_place && !motions_[a].keeps_its_place) decision.a_may = false;
    }
    decisions_.push_back(std::move(decision));
  }

  static bool is_behind(const CoordinatedMotion& motion, Duration to) {
    return to < motion.progress && to < motion.duration;
  }
  // It has, or may have, entered what begins at `from` when the other one passes: it stands at its
  // start now, or does before the other one begins, which follows what brings it there.
  [[nodiscard]] bool reaches(std::size_t m, Duration from, std::size_t other) const {
    if (from < motions_[m].authority) return true;
    const bool at_start = from <= Duration{} && motions_[m].authority <= Duration{};
    return at_start && (stands_[m] || std::ranges::any_of(before_[m], [&](std::size_t ahead) {
                          return ahead < other && share_an_arm(motions_[ahead], motions_[other]);
                        }));
  }
  // It comes to rest there and nothing takes it away, or only what follows the other one.
  [[nodiscard]] bool blocks_end(std::size_t m, Duration to, std::size_t other) const {
    if (to < motions_[m].duration) return false;
    if (!moves_on(m)) return true;
    for (std::size_t next = std::max(m, other) + 1; next < motions_.size(); ++next) {
      const bool follows = std::ranges::find(before_[next], m) != before_[next].end();
      if (follows && share_an_arm(motions_[next], motions_[other])) return true;
    }
    return false;
  }
  void note_in_the_way(std::size_t m) {
    for (const ArmId arm : motions_[m].arms) answer_.in_the_way.push_back(arm);
  }

  // ---- Rests between two motions of an arm: their regions are decided alike ----

  void tie_chains() {
    ties_.resize(decisions_.size());
    for (std::size_t d = 0; d < decisions_.size(); ++d) {
      for (std::size_t e = 0; e < decisions_.size(); ++e) {
        if (d == e) continue;
        tie(d, e);
      }
    }
  }

  // If d ends where e begins, in the way of the same other motion.
  void tie(std::size_t d, std::size_t e) {
    for (const bool d_side : {true, false}) {    // its chain is d's A
      for (const bool e_side : {true, false}) {  // and e's A
        const std::size_t ends = d_side ? decisions_[d].a : decisions_[d].b;
        const std::size_t begins = e_side ? decisions_[e].a : decisions_[e].b;
        const std::size_t passes_d = d_side ? decisions_[d].b : decisions_[d].a;
        const std::size_t passes_e = e_side ? decisions_[e].b : decisions_[e].a;
        if (passes_d != passes_e) continue;
        const auto& before = before_[begins];
        if (std::ranges::find(before, ends) == before.end()) continue;
        if (!meet_at_rest(decisions_[d], d_side, decisions_[e], e_side, motions_[ends].duration)) {
          continue;
        }
        const bool turned = d_side != e_side;
        ties_[d].push_back({e, turned});
        ties_[e].push_back({d, turned});
      }
    }
  }

  static bool meet_at_rest(const Decision& d, bool d_side, const Decision& e, bool e_side,
                           Duration end) {
    for (const ProgressBox& last : d.region.boxes) {
      if ((d_side ? last.to_a : last.to_b) < end) continue;
      for (const ProgressBox& first : e.region.boxes) {
        if ((e_side ? first.from_a : first.from_b) > Duration{}) continue;
        if (overlap(d_side ? last.from_b : last.from_a, d_side ? last.to_b : last.to_a,
                    e_side ? first.from_b : first.from_a, e_side ? first.to_b : first.to_a)) {
          return true;
        }
      }
    }
    return false;
  }

  void collect_choices() {
    first_.assign(decisions_.size(), true);
    std::vector<bool> seen(decisions_.size(), false);
    for (std::size_t d = 0; d < decisions_.size(); ++d) {
      if (seen[d]) continue;
      Choice choice{.members = {{d, false}}, .options = {}};
      seen[d] = true;
      for (std::size_t i = 0; i < choice.members.size(); ++i) {  // grows
        const Choice::Member member = choice.members[i];
        for (const Choice::Member& tied : ties_[member.decision]) {
          if (seen[tied.decision]) continue;
          seen[tied.decision] = true;
          choice.members.push_back({tied.decision, member.turned != tied.turned});
        }
      }
      for (const bool value : {false, true}) {  // the earlier one of the pair first
        const bool a_first = decisions_[d].prefers_a ? !value : value;
        if (allowed(choice, a_first)) choice.options.push_back(a_first);
      }
      if (choice.options.empty()) {
        report_blocked(choice);
      } else {
        set(choice, choice.options.front());
        choices_.push_back(std::move(choice));
      }
    }
  }

  [[nodiscard]] bool allowed(const Choice& choice, bool a_first) const {
    return std::ranges::all_of(choice.members, [&](const Choice::Member& member) {
      const Decision& decision = decisions_[member.decision];
      return a_first != member.turned ? decision.a_may : decision.b_may;
    });
  }

  void set(Choice& choice, bool value) {
    choice.value = value;
    for (const Choice::Member& member : choice.members) {
      first_[member.decision] = value != member.turned;
    }
  }

  // ---- What is best ----

  [[nodiscard]] Precedence precedence_of(std::size_t d, bool a_first) const {
    const Decision& decision = decisions_[d];
    return {motions_[decision.a].job, motions_[decision.b].job, decision.region, a_first};
  }

  // Smaller is better, entry by entry.
  using Cost = std::vector<double>;

  Cost evaluate(Prediction& prediction) {
    std::vector<Dependency> dependencies;
    for (std::size_t d = 0; d < decisions_.size(); ++d) {
      const Decision& decision = decisions_[d];
      const bool a_first = first_[d];
      dependencies.push_back({a_first ? decision.a : decision.b, a_first ? decision.b : decision.a,
                              &ordered_[d][a_first ? 0 : 1]});
    }
    prediction = predict(ahead_, dependencies);
    return cost_of(prediction);
  }

  [[nodiscard]] Cost cost_of(const Prediction& prediction) const {
    Cost cost{static_cast<double>(prediction.stuck.size())};
    std::map<int, std::map<ArmId, double>, std::greater<>> finish;  // by priority, arm
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      for (const ArmId arm : motions_[m].arms) {
        double& last = finish[motions_[m].priority][arm];
        last = std::max(last, to_seconds(prediction.ends[m]));
      }
    }
    for (const auto& [priority, arms] : finish) {
      double last = 0.0, sum = 0.0;
      for (const auto& [arm, end] : arms) {
        last = std::max(last, end + to_seconds(work_behind_[arm.index()]));
        sum += end;
      }
      cost.push_back(last + kWeightOfSum * sum);
    }
    return cost;
  }

  void search() {
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      ahead_.push_back({motions_[m].progress, motions_[m].duration, before_[m]});
    }
    ordered_.resize(decisions_.size());
    for (std::size_t d = 0; d < decisions_.size(); ++d) {
      ordered_[d] = {precedence_of(d, true), precedence_of(d, false)};
    }
    const std::vector<Choice*> free = free_choices();
    best_ = evaluate(best_prediction_);
    if (free.size() <= kTriedInFull) {
      try_all(free);
    } else {
      change_single(free);
    }
  }

  // Those of the candidates' regions, then those of motions that a candidate meets.
  std::vector<Choice*> free_choices() {
    std::vector<bool> met(motions_.size(), false);
    for (std::size_t d = decided_; d < decisions_.size(); ++d) {
      met[decisions_[d].a] = met[decisions_[d].b] = true;
    }
    std::vector<Choice*> free, further;
    for (Choice& choice : choices_) {
      if (choice.options.size() < 2) continue;
      const bool own = std::ranges::any_of(choice.members, [&](const Choice::Member& member) {
        return member.decision >= decided_;
      });
      const bool near = std::ranges::any_of(choice.members, [&](const Choice::Member& member) {
        return met[decisions_[member.decision].a] || met[decisions_[member.decision].b];
      });
      if (own) free.push_back(&choice);
      if (near && !own) further.push_back(&choice);
    }
    free.insert(free.end(), further.begin(), further.end());
    if (free.size() > kFreeMax) free.resize(kFreeMax);
    return free;
  }

  void try_all(const std::vector<Choice*>& free) {
    std::size_t best = 0;
    for (std::size_t which = 1; which < (std::size_t{1} << free.size()); ++which) {
      assign(free, which);
      if (is_better()) best = which;
    }
    assign(free, best);
  }
  void assign(const std::vector<Choice*>& free, std::size_t which) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      set(*free[i], free[i]->options[which >> i & 1U]);
    }
  }

  void change_single(const std::vector<Choice*>& free) {
    for (int pass = 0; pass < kPasses; ++pass) {
      bool changed = false;
      for (Choice* choice : free) {
        set(*choice, !choice->value);
        if (is_better()) {
          changed = true;
        } else {
          set(*choice, !choice->value);
        }
      }
      if (!changed) return;
    }
  }

  bool is_better() {
    constexpr double kLeast_s = 1e-3;
    Prediction prediction;
    Cost cost = evaluate(prediction);
    for (std::size_t i = 0; i < cost.size(); ++i) {
      if (cost[i] > best_[i] - kLeast_s && cost[i] < best_[i] + kLeast_s) continue;
      if (cost[i] > best_[i]) return false;
      best_ = std::move(cost);
      best_prediction_ = std::move(prediction);
      return true;
    }
    return false;
  }

  // ---- Why not ----

  void report(std::size_t d) {
    const Decision& decision = decisions_[d];
    const ConflictRegion& region = decision.region;
    const bool own_is_a = decision.a >= first_candidate_;
    answer_.obstacles.push_back({motions_[own_is_a ? decision.a : decision.b].job,
                                 motions_[own_is_a ? decision.b : decision.a].job, std::nullopt,
                                 own_is_a ? region.proximity : turned_around(region.proximity),
                                 own_is_a ? region.time_a : region.time_b,
                                 own_is_a ? region.time_b : region.time_a});
  }

  void report_blocked(const Choice& choice) {
    for (const Choice::Member& member : choice.members) {
      if (member.decision >= decided_) return report(member.decision);
    }
  }

  // Everything would wait in a ring: the candidates' own decisions in it say why.
  void report_ring() {
    const auto& ring = best_prediction_.ring;
    const auto in_ring = [&](std::size_t m) { return std::ranges::find(ring, m) != ring.end(); };
    for (std::size_t d = decided_; d < decisions_.size(); ++d) {
      if (in_ring(decisions_[d].a) && in_ring(decisions_[d].b)) report(d);
    }
    if (answer_.obstacles.empty() && decisions_.size() > decided_) report(decided_);
  }

  std::vector<CoordinatedMotion> motions_;
  std::size_t first_candidate_;
  const std::vector<Duration>& work_behind_;
  std::vector<std::vector<std::size_t>> before_;  // by motion: the ones before it on its arms
  std::vector<bool> stands_;                      // by motion: some arm of it is at its start now
  std::vector<std::size_t> followed_;             // by motion: how many of its arms move on

  std::vector<Decision> decisions_;  // those of the past first
  std::size_t decided_ = 0;
  std::vector<std::vector<Choice::Member>> ties_;  // by decision
  std::vector<bool> first_;                        // by decision: A goes first
  std::vector<Choice> choices_;

  std::vector<MotionAhead> ahead_;
  std::vector<std::vector<Precedence>> ordered_;  // by decision: A first, B first
  Cost best_;
  Prediction best_prediction_;
  PassingOrders answer_;
};

}  // namespace

PassingOrders find_passing_orders(const std::vector<CoordinatedMotion>& admitted,
                                  const std::vector<Precedence>& precedences,
                                  const std::vector<CoordinatedMotion>& candidates,
                                  const std::vector<PairRegions>& regions,
                                  const std::vector<Duration>& work_behind) {
  return Search(admitted, precedences, candidates, work_behind).run(regions);
}

bool share_an_arm(const CoordinatedMotion& a, const CoordinatedMotion& b) {
  return std::ranges::any_of(
      a.arms, [&](ArmId arm) { return std::ranges::find(b.arms, arm) != b.arms.end(); });
}

Verdict as_verdict(const PassingOrders& orders, std::size_t candidates, Verdict verdict) {
  if (verdict.kind != Verdict::Kind::free) return verdict;
  verdict.regions.clear();
  if (orders.obstacles.empty()) {
    verdict.earliest_start =
        *(orders.prediction.begins.end() - static_cast<std::ptrdiff_t>(candidates));
    return verdict;
  }
  verdict.kind = Verdict::Kind::conflict;
  verdict.clearance_bound_m.reset();
  for (const Obstacle& obstacle : orders.obstacles) {
    verdict.conflicts.push_back({obstacle.arm ? Conflict::With::rest : Conflict::With::motion,
                                 obstacle.candidate, obstacle.other, obstacle.proximity,
                                 obstacle.own_time, obstacle.other_time});
  }
  return verdict;
}

}  // namespace armloom
