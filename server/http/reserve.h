#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "server/http/asio.h"

namespace armloom {

// Extra connection slots, in which a stop is served when no regular connection is left. Each free
// slot keeps a spare file descriptor open, in case the system runs out of descriptors. When all
// slots are taken, a new connection evicts the oldest connection of the client that has the most.
// So no client can lock out others. A connection that is being answered is never evicted. Use on
// the server's thread.
class Reserve {
 public:
  explicit Reserve(std::size_t places) : places_(places) {}
  ~Reserve();
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;

  // Opens the missing spare descriptors, as many as the system grants. Call at the start and after
  // each reserve connection.
  void fill();
  // Frees a descriptor for another connection, if necessary by eviction. Returns false if no
  // connection can be evicted.
  bool make_room();

  // A connection's slot. Precondition: make_room() returned true. The reserve and `socket` must
  // outlive the slot. Eviction closes `socket`.
  class Place {
   public:
    Place(Reserve& reserve, Socket& socket, std::string client)
        : reserve_(reserve), number_(reserve.next_number_++) {
      reserve.inside_.emplace(number_, Inside{&socket, std::move(client)});
    }
    ~Place() { reserve_.inside_.erase(number_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    // Prevents eviction (true) or permits it again (false). Returns false if the connection was
    // already evicted.
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
  std::vector<int> held_;  // spare descriptors
  std::uint64_t next_number_ = 0;
  std::map<std::uint64_t, Inside> inside_;  // oldest first
};

}  // namespace armloom
