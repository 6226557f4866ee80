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

// A job that waits, as a leg of the lanes of its arms: from rest to rest.
struct WaitingLeg {
  JobId job;
  std::vector<ArmId> arms;
  std::vector<PlacePtr> from;  // by arm, as in `arms`
  std::vector<PlacePtr> to;
  std::vector<JobId> after = {};  // it does not begin before these, as long as they wait
  // Of the job's motions, which one: what was answered about another one is not known of it.
  std::uint64_t motion = 0;
  // Its way is still to be planned, from wherever its arm will stand and past where all others will
  // when the legs given before it are done: these it is taken to pass. Of other places an estimate
  // of its way is asked.
  bool is_estimate = false;
  // Its arms are brought to where it begins, wherever they stand, by ways that are estimates too.
  bool is_approached = false;
};

// Does this leg find its way free while an arm that it does not move rests there?
struct Passage {
  JobId leg;
  PlacePtr place;
  std::uint64_t motion = 0;  // WaitingLeg::motion
  PlacePtr from = nullptr;   // not null: its arm is brought from there to where the leg begins
};

// The banker's question (Dijkstra 1965) with places in the way instead of money: when all that is
// admitted has come to its end, can everything that waits still be done, at least one after the
// other? The order of submission is the first witness of it; where that is not kept, another one is
// sought near the front of it. As long as an admission leaves such a sequence, what could be done
// in turn can still be done.
//
// Geometry is asked as little as possible: what is not known about a leg is asked when that is
// among the first kKnownAhead of the sequence, or would be done after an admission instead of
// before it; until then it is taken to be free. What was answered is kept for each leg and place.
//
// A leg for which no sequence is known is in none, nor is what follows it; nobody waits for it.
// Pure.
class SafeSequence {
 public:
  // Legs that begin no farther than this from where their arms will stand follow on.
  explicit SafeSequence(double start_tolerance) : tolerance_(start_tolerance) {}
  SafeSequence(const SafeSequence& other);
  SafeSequence(SafeSequence&&) = default;
  SafeSequence& operator=(SafeSequence&&) = default;
  ~SafeSequence() = default;

  inline static constexpr std::size_t kKnownAhead = 16;
  inline static constexpr std::size_t kUnknownMax = 128;  // passages that are asked at once
  inline static constexpr std::size_t kSearched = 20;     // legs that are put into another order
  inline static constexpr std::size_t kStatesMax = 1000;  // of a search

  // A leg comes to the end of its lanes. Precondition: renew() has been called once.
  void append(WaitingLeg leg);
  // A leg that was not admitted is no more. Where others may not follow on then: false, renew().
  [[nodiscard]] bool remove(JobId job);
  // These legs have been admitted, as after() was asked: their arms will stand at their ends.
  void admitted(const std::vector<JobId>& group);
  // Everything anew: where arms stand at the end of what is admitted, and what waits, in an order
  // that every lane allows. What is known of legs is kept; those that were there before keep their
  // order in the sequence.
  void renew(std::vector<PlacePtr> stands, const std::vector<WaitingLeg>& legs);

  // Answers to Passages; of two arms: they never meet, wherever they are.
  void learn(const Passage& passage, bool free);
  void learn_apart(ArmId a, ArmId b) {
    apart_[a.index()][b.index()] = apart_[b.index()][a.index()] = true;
  }
  void forget_passages();

  // Of two legs, as the sequence is now; one that is in none comes after all. False: the first one
  // is in none. Linear in its place.
  [[nodiscard]] bool goes_before(JobId first, JobId other) const;
  // Whether it is in the sequence, as far as is known; true: nothing is known of it.
  [[nodiscard]] bool has_place(JobId job) const;
  // It begins where the legs before it will leave its arms.
  [[nodiscard]] bool follows_on(JobId job) const;

  struct Outlook {
    std::vector<Passage> unknown;  // to be learnt first; then ask again
    std::vector<Passage> ahead;    // good to know in time, to see dead ends from afar
    std::optional<JobId> first;    // has to be done before them
    bool all = true;               // else some legs are in no sequence, even then
  };
  // What remains if these legs are admitted now: a sequence, where nothing is unknown or first.
  // Precondition: each is the first of its lanes, but for others of them that are named before it.
  [[nodiscard]] Outlook after(const std::vector<JobId>& group);

 private:
  using Free = std::unordered_map<std::uint64_t, bool>;  // by Place::id
  struct Approach {
    PlacePtr from;
    Free free = {};
  };
  struct Leg : WaitingLeg {
    Free free = {};
    std::vector<Approach> approaches = {};  // of arms that are brought to where it begins
    std::vector<std::uint64_t> seen = {};   // Place::id by arm: it passes where they stand so
    bool placed = false;                    // in sequence_, else in unplaced_
    bool cut = false;                       // does not begin where its lanes lead
  };
  using Legs = std::list<Leg>;
  using Order = std::vector<Leg*>;
  using State = std::vector<PlacePtr>;  // by ArmId: where it rests
  enum class Passes { free, blocked, unknown };
  struct Walk {
    std::vector<Passage> unknown;
    Leg* blocked = nullptr;
  };
  struct Concerned {
    Order legs;
    std::size_t overtaken = 0;  // of these, the first ones: they would have been done before
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
  State stands_;  // at the end of what is admitted
  State ends_;    // at the end of everything
  Legs sequence_;
  Legs unplaced_;                           // in no sequence; none before what it follows
  std::vector<std::size_t> unplaced_legs_;  // by ArmId: how many
  std::unordered_map<JobId, Legs::iterator> index_;
  std::vector<std::vector<bool>> apart_;  // by ArmId, ArmId
  bool tried_ = false;                    // in vain to place more, as things are
  std::vector<JobId> asked_;              // after() was asked last about these
  Order found_;                           // what to begin the sequence with then
};

}  // namespace armloom
