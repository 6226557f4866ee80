#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/sequence/places.h"

namespace armloom {

struct PassageBlock;  // evidence that a passage is blocked; only stored here

// The part of a waiting step that the sequence uses: its motion from rest to rest.
struct WaitingLeg {
  StepId step;
  std::vector<ArmId> arms;
  std::vector<PlacePtr> from;  // by arm, as in `arms`
  std::vector<PlacePtr> to;
  std::vector<StepId> after = {};  // waiting steps that must be done before it
  // Revision of the step's motion. Cached answers apply only to the revision for which they were
  // given.
  std::uint64_t motion = 0;
  // The path is still to be planned, around all other arms where they are when the legs before it
  // are done. So the leg is assumed to pass those places. For other places the estimated path is
  // checked.
  bool is_estimate = false;
  // The step's arms are first moved to its start from wherever they are, on estimated paths.
  bool is_approached = false;
};

// The question whether the leg's path is free while an arm that the leg does not move rests at
// `place`.
struct Passage {
  StepId leg;
  PlacePtr place;
  std::uint64_t motion = 0;  // WaitingLeg::motion
  PlacePtr from = nullptr;   // if set: the question is about the move from there to the leg's start
};

// Keeps an order in which all waiting steps can be done, at least one after the other, when all
// admitted steps have ended. This is Dijkstra's banker's algorithm (1965) with places instead of
// money. The first such order is the order of submission. If an admission breaks the order, another
// order of the first legs is searched.
//
// Geometry is queried only about the first kKnownAhead legs and about legs that an admission
// overtakes. Other unknown passages are assumed to be free. Answers are cached by leg and place.
//
// A leg for which no order is found, and all legs that depend on it, are not in the sequence, and
// no step waits for them. Pure.
class SafeSequence {
 public:
  // `start_tolerance`: largest distance per joint (rad, m) between a leg's start and the position
  // where the legs before it leave the arm.
  explicit SafeSequence(double start_tolerance) : tolerance_(start_tolerance) {}
  SafeSequence(const SafeSequence& other);
  SafeSequence(SafeSequence&&) = default;
  SafeSequence& operator=(SafeSequence&&) = default;
  ~SafeSequence() = default;

  inline static constexpr std::size_t kKnownAhead = 16;
  inline static constexpr std::size_t kUnknownMax = 128;  // passages in one query
  inline static constexpr std::size_t kSearched = 20;     // legs that a search reorders
  inline static constexpr std::size_t kStatesMax = 1000;  // states per search

  // Adds a leg at the end of its arm queues. Precondition: renew() has been called once.
  void append(WaitingLeg leg);
  // Removes a leg that was not admitted. Returns false if later legs may no longer begin where
  // their arms will be; then call renew().
  [[nodiscard]] bool remove(StepId step);
  // Records that the group of the last after() call was admitted. Its arms will be at the ends of
  // these legs.
  void admitted(const std::vector<StepId>& group);
  // Rebuilds the sequence. `stands`: the place of each arm when all admitted steps have ended.
  // `legs`: all waiting legs, in an order that every arm queue allows. Keeps cached answers and, if
  // possible, the previous order of the legs.
  void renew(std::vector<PlacePtr> stands, const std::vector<WaitingLeg>& legs);

  // Store that a passage is free or blocked, with the evidence if known; or that two arms cannot
  // meet at any position.
  void learn(const Passage& passage, bool free,
             std::shared_ptr<const PassageBlock> block = nullptr);
  void learn_apart(ArmId a, ArmId b) {
    apart_[a.index()][b.index()] = apart_[b.index()][a.index()] = true;
  }
  void forget_passages();

  // Returns true if `first` is in the sequence, and `other` comes later or is not in it. Takes time
  // linear in the position of the earlier one.
  [[nodiscard]] bool goes_before(StepId first, StepId other) const;
  // Returns the newest job that a search for another order may have used. If it is newer than at
  // the last after() call, a group that had to wait for Outlook::first may perhaps go first.
  [[nodiscard]] JobId newest() const { return newest_; }
  // Returns true if the step is in the sequence, or if it is not a waiting leg.
  [[nodiscard]] bool has_place(StepId step) const;
  [[nodiscard]] bool has(StepId leg) const { return index_.contains(leg); }
  // Returns true if the step begins where the legs before it leave its arms, or if it is not a
  // waiting leg.
  [[nodiscard]] bool follows_on(StepId step) const;

  struct Outlook {
    std::vector<Passage> unknown;  // must be learned before an answer; then call after() again
    // Not needed for this answer; learned early, they show dead ends early.
    std::vector<Passage> ahead;
    std::optional<StepId> first;  // if set: this leg must be done before the group, ...
    // ... because an arm would rest in its path: the place, and the evidence if known
    PlacePtr in_the_way = nullptr;
    std::shared_ptr<const PassageBlock> block = nullptr;
    bool all = true;  // false if some legs would be in no sequence
  };
  // Returns what remains of the sequence if these legs are admitted now. A sequence exists if
  // `unknown` and `first` are empty. Precondition: each leg is the first in its arm queues, except
  // for legs named before it in the group.
  [[nodiscard]] Outlook after(const std::vector<StepId>& group);

 private:
  struct Known {
    bool free;
    std::shared_ptr<const PassageBlock> block = nullptr;  // evidence, if blocked
  };
  using Free = std::unordered_map<std::uint64_t, Known>;  // by Place::id
  struct Approach {
    PlacePtr from;
    Free free = {};
  };
  struct Leg : WaitingLeg {
    Free free = {};
    std::vector<Approach> approaches = {};  // moves of arms to its start
    // By ArmId: Place::id of each arm in the last state that the leg passed.
    std::vector<std::uint64_t> seen = {};
    bool placed = false;  // in sequence_, else in unplaced_
    bool cut = false;     // does not begin where the legs before it leave its arms
  };
  using Legs = std::list<Leg>;
  using Order = std::vector<Leg*>;
  using State = std::vector<PlacePtr>;  // by ArmId: its place
  enum class Passes { free, blocked, unknown };
  struct Walk {
    std::vector<Passage> unknown;
    Leg* blocked = nullptr;
    PlacePtr in_the_way = nullptr;  // of `blocked`, with the evidence if known
    std::shared_ptr<const PassageBlock> block = nullptr;
  };
  struct Concerned {
    Order legs;
    std::size_t overtaken = 0;  // number of first legs that the group overtakes
  };
  class Search;

  static void move(State& state, const WaitingLeg& leg);
  void add(WaitingLeg leg);
  static void assume(Leg& leg, const State& past);
  [[nodiscard]] bool follows(const Leg& leg) const;
  Passes passes(Leg& leg, const State& state, std::vector<Passage>* unknown, Walk* walk = nullptr);
  Walk walk(State state, std::span<Leg* const> order);
  [[nodiscard]] Concerned concerned(const std::vector<StepId>& group, const State& then);
  [[nodiscard]] Order all_that_may_go(const std::vector<StepId>& but);
  std::optional<Order> search(const State& state, Order legs);
  std::optional<Outlook> mend(const State& then, const Order& legs, const Walk& walk_then,
                              bool& mended);
  void place_more(std::vector<Passage>& unknown);
  void place_behind(std::vector<Passage>& unknown);
  void put_in_order(const Order& order);
  void take_out(Leg& leg);

  double tolerance_;
  State stands_;  // when all admitted steps have ended
  State ends_;    // when all steps have ended
  Legs sequence_;
  Legs unplaced_;  // legs in no sequence; each comes after the legs that it depends on
  std::vector<std::size_t> unplaced_legs_;  // by ArmId: number of legs
  std::unordered_map<StepId, Legs::iterator> index_;
  std::vector<std::vector<bool>> apart_;  // by ArmId, ArmId
  JobId newest_{0};
  bool tried_ = false;         // no more legs could be placed, and nothing has changed since
  std::vector<StepId> asked_;  // the group of the last after() call
  Order found_;                // the new front of the sequence if that group is admitted
};

}  // namespace armloom
