#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// Control: the right to jog arms. At most one client has it and shows a secret key. The client may
// give it back, and another client may take it over. Jobs need no control. Use on the server's
// thread.
class Control {
 public:
  // Time of the machine's clock, because the cell's clock stands still while the process is
  // stopped.
  using Time = std::chrono::steady_clock::time_point;
  struct Move {
    std::string arm;
    std::string job;  // its key
    Time held_at{};   // time of the last report that the button is held
  };
  struct Holder {
    std::string who;                   // display name
    std::optional<std::string> token;  // used to take control, if tokens are required
    std::chrono::system_clock::time_point since;
    std::optional<Move> move = {};  // last jog
  };
  struct Taken {
    std::string key;                  // the secret
    std::optional<Move> interrupted;  // jog of the previous holder; must be canceled
  };
  // Gives control to the client `who`. Problem (conflict): another client has control, and
  // `from_another` is false.
  [[nodiscard]] Result<Taken> take(const std::string& who, bool from_another,
                                   std::optional<std::string> token = {});
  // Ends the client's control. Returns its last jog, if any, which the caller must cancel. Problem
  // (conflict): the key does not belong to the client in control.
  [[nodiscard]] Result<std::optional<Move>> give_back(const std::string& key);
  // Revokes control. Returns the last jog, if any, which the caller must cancel. Precondition: a
  // client has control.
  std::optional<Move> end();
  // Problem (conflict): the key does not belong to the client in control.
  [[nodiscard]] Result<void> check(const std::string& key) const;
  // Precondition: a client has control.
  void begin(Move move) { holder_->move = std::move(move); }
  // Renews the jog's lease at `now`. Returns false if the lease has expired: the jog is then over.
  // Precondition: a client has control and has begun a jog.
  [[nodiscard]] bool renew(std::chrono::milliseconds lease, Time now);

  [[nodiscard]] const std::optional<Holder>& holder() const { return holder_; }

 private:
  std::optional<Holder> holder_;
  std::string key_;
};

}  // namespace armloom
