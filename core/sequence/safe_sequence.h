#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/sequence/places.h"

namespace armloom {

// A waiting job as a leg of the sequence: from rest to rest.
struct WaitingLeg {
  JobId job;
  std::vector<ArmId> arms;
  std::vector<PlacePtr> from;  // by arm, as in `arms`
  std::vector<PlacePtr> to;
  std::vector<JobId> after = {};  // does not begin before these waiting jobs
  // Revision of the job's motion; cached answers for other revisions do not apply.
  std::uint64_t motion = 0;
  // The path is still to be planned, around all other arms when the legs before it are done: it is
  // assumed to pass those. For other places the estimate is checked.
  bool is_estimate = false;
  // Its arms are moved to its start from wherever they are, on estimated paths.
  bool is_approached = false;
};

// Is the leg's path free while an arm that it does not move rests at `place`?
struct Passage {
  JobId leg;
  PlacePtr place;
  std::uint64_t motion = 0;  // WaitingLeg::motion
  PlacePtr from = nullptr;   // if set: asks about the move from there to the leg's start
};

// Dijkstra's banker's algorithm (1965) with places instead of money: when all admitted jobs have
// ended, can all waiting jobs still be done, at least one after the other? The order of submission
// is the first witness. If an admission breaks it, another order of the first legs is searched.
//
// Geometry is queried only about the first kKnownAhead legs and about legs that an admission
// overtakes. Until then an unknown passage is assumed free. Answers are cached by leg and place.
//
// A leg without a known sequence, and all that follows it, is in none; no job waits for it. Pure.
class SafeSequence {
 public:
  // `start_tolerance`: largest distance between a leg's start and its arm's position for the leg to
  // follow on.
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
  // Removes a leg that was not admitted. Returns false if later legs may no longer follow on; then
  // call renew().
  [[nodiscard]] bool remove(JobId job);
  // Records the admission that after() was last asked about: the arms will be at these legs' ends.
  void admitted(const std::vector<JobId>& group);
  // Rebuilds the sequence from the arms' places after all admitted jobs and the waiting legs, in an
  // order that every arm queue allows. Keeps cached answers and the order of known legs.
  void renew(std::vector<PlacePtr> stands, const std::vector<WaitingLeg>& legs);

  // Store answers: for a passage; for two arms that never meet at any position.
  void learn(const Passage& passage, bool free);
  void learn_apart(ArmId a, ArmId b) {
    apart_[a.index()][b.index()] = apart_[b.index()][a.index()] = true;
  }
  void forget_passages();

  // Returns true if `first` precedes `other`; legs in no sequence come last. False if `first` is in
  // no sequence. Linear in its position.
  [[nodiscard]] bool goes_before(JobId first, JobId other) const;
  // Returns true if the job is in the sequence, or unknown.
  [[nodiscard]] bool has_place(JobId job) const;
  // Returns true if the job begins where the legs before it leave its arms, or is unknown.
  [[nodiscard]] bool follows_on(JobId job) const;

  struct Outlook {
    std::vector<Passage> unknown;  // must be learned first; then call after() again
    std::vector<Passage> ahead;    // useful to learn ahead of time, to see dead ends early
    std::optional<JobId> first;    // must be done before the group
    bool all = true;               // false if some legs remain in no sequence
  };
  // Returns what remains if these legs are admitted now: a sequence exists if `unknown` and `first`
  // are empty. Precondition: each is the first of its arm queues, except for members of the group
  // named before it.
  [[nodiscard]] Outlook after(const std::vector<JobId>& group);

 private:
  using Free = std::unordered_map<std::uint64_t, bool>;  // by Place::id
  struct Approach {
    PlacePtr from;
    Free free = {};
  };
  struct Leg : WaitingLeg {
    Free free = {};
    std::vector<Approach> approaches = {};  // moves of arms to its start
    std::vector<std::uint64_t> seen = {};   // Place::id by arm for which it is known to pass
    bool placed = false;                    // in sequence_, else in unplaced_
    bool cut = false;                       // does not begin where its arm queues lead
  };
  using Legs = std::list<Leg>;
  using Order = std::vector<Leg*>;
  using State = std::vector<PlacePtr>;  // by ArmId: its place
  enum class Passes { free, blocked, unknown };
  struct Walk {
    std::vector<Passage> unknown;
    Leg* blocked = nullptr;
  };
  struct Concerned {
    Order legs;
    std::size_t overtaken = 0;  // the first `overtaken` legs would have been done before the group
  };
  class Search;

  static void move(State& state, const WaitingLeg& leg);
  void add(WaitingLeg leg);
  static void assume(Leg& leg, const State& past);
  [[nodiscard]] bool follows(const Leg& leg) const;
  Passes passes(Leg& leg, const State& state, std::vector<Passage>* unknown);
  Walk walk(State state, std::span<Leg* const> order);
  [[nodiscard]] Concerned concerned(const std::vector<JobId>& group, const State& then);
  [[nodiscard]] Order all_that_may_go(const std::vector<JobId>& but);
  std::optional<Order> search(const State& state, Order legs);
  std::optional<Outlook> mend(const State& then, const Order& legs, Leg& blocked, bool& mended);
  void place_more(std::vector<Passage>& unknown);
  void place_behind(std::vector<Passage>& unknown);
  void put_in_order(const Order& order);
  void take_out(Leg& leg);

  double tolerance_;
  State stands_;  // when all admitted jobs have ended
  State ends_;    // when all jobs have ended
  Legs sequence_;
  Legs unplaced_;  // in no sequence; none precedes a leg that it depends on
  std::vector<std::size_t> unplaced_legs_;  // by ArmId: number of legs
  std::unordered_map<JobId, Legs::iterator> index_;
  std::vector<std::vector<bool>> apart_;  // by ArmId, ArmId
  bool tried_ = false;                    // placing more legs failed, and nothing has changed since
  std::vector<JobId> asked_;              // the group of the last after() call
  Order found_;                           // the new front of the sequence for it
};

}  // namespace armloom
