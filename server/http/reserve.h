#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "server/http/asio.h"

namespace armloom {

// Places for connections beyond those that are served, in which a stop is taken all the same. A
// file descriptor is held for each, so that there is one when the system gives no other. For one
// more connection than there are places the oldest goes: whoever holds them all cannot keep others
// out. On the server's thread.
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
  // does `stream`, which is closed when the connection has to go.
  class Place {
   public:
    Place(Reserve& reserve, boost::beast::tcp_stream& stream)
        : reserve_(reserve), number_(reserve.next_number_++) {
      reserve.inside_.emplace(number_, &stream);
    }
    ~Place() { reserve_.inside_.erase(number_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    Reserve& reserve_;
    std::uint64_t number_;
  };

 private:
  bool let_oldest_go();

  std::size_t places_;
  std::vector<int> held_;  // descriptors
  std::uint64_t next_number_ = 0;
  std::map<std::uint64_t, boost::beast::tcp_stream*> inside_;  // in the order in which they came
};

}  // namespace armloom
