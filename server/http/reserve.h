#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "server/http/asio.h"

namespace armloom {

// Places for connections beyond those that are served, in which a stop is taken all the same. A
// file descriptor is held for each, so that there is one when the system gives no other. For one
// more connection than there are places one has to go: the oldest of the client that has most, so
// that whoever holds them all cannot keep others out; never one whose request is being answered.
// On the server's thread.
class Reserve {
 public:
  explicit Reserve(std::size_t places) : places_(places) {}
  ~Reserve();
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;

  // Takes the descriptors that are missing, as far as they can be had: at the start, and when a
  // connection of the reserve has ended.
  void fill();
  // Gives a descriptor back to the system, for one more connection. False: there is none.
  bool make_room();

  // That a connection is in it, for which make_room() was called. The reserve outlives it, and so
  // does `socket`, which is closed when the connection has to go.
  class Place {
   public:
    Place(Reserve& reserve, Socket& socket, std::string client)
        : reserve_(reserve), number_(reserve.next_number_++) {
      reserve.inside_.emplace(number_, Inside{&socket, std::move(client)});
    }
    ~Place() { reserve_.inside_.erase(number_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    // From when its request is read until the answer is written. False: it has been let go.
    bool keep(bool is_kept);

   private:
    Reserve& reserve_;
    std::uint64_t number_;
  };

 private:
  struct Inside {
    Socket* socket;
    std::string client;
    bool is_kept = false;
  };
  bool let_one_go();

  std::size_t places_;
  std::vector<int> held_;  // descriptors
  std::uint64_t next_number_ = 0;
  std::map<std::uint64_t, Inside> inside_;  // in the order in which they came
};

}  // namespace armloom
