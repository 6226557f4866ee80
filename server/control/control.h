#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// Who may move arms by hand: one client at a time, who shows a key that nobody else was told. It
// may be given back, or taken by another. Jobs of programs need no control. On the server's thread.
class Control {
 public:
  // On the machine's own clock: the cell's stands still while the process is stopped.
  using Time = std::chrono::steady_clock::time_point;
  struct Move {
    std::string arm;
    std::string job;  // its key
    Time held_at{};   // when it was said last that the button is held
  };
  struct Holder {
    std::string who;                   // for people
    std::optional<std::string> token;  // by which it was taken, where tokens are asked for
    std::chrono::system_clock::time_point since;
    std::optional<Move> move = {};  // the last that was begun by hand
  };
  struct Taken {
    std::string key;                  // the secret
    std::optional<Move> interrupted;  // the move of whoever held it before: to be cancelled
  };
  // Problem (conflict): somebody else holds it, and it is not to be taken `from_another`.
  [[nodiscard]] Result<Taken> take(const std::string& who, bool from_another,
                                   std::optional<std::string> token = {});
  // The last move of who gives it back. Problem: that of check().
  [[nodiscard]] Result<std::optional<Move>> give_back(const std::string& key);
  // Takes it from whoever holds it, for nobody; their last move. Precondition: somebody does.
  std::optional<Move> end();
  // Problem (conflict): the key is not that of who holds it.
  [[nodiscard]] Result<void> check(const std::string& key) const;
  // Precondition: somebody holds it.
  void begin(Move move) { holder_->move = std::move(move); }
  // Its button is said to be held at `now`: whether the word came within the lease. One that comes
  // late finds that the move is over. Precondition: somebody holds it, and moves something.
  [[nodiscard]] bool renew(std::chrono::milliseconds lease, Time now);

  [[nodiscard]] const std::optional<Holder>& holder() const { return holder_; }

 private:
  std::optional<Holder> holder_;
  std::string key_;
};

}  // namespace armloom
