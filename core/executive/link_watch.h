#pragma once

#include <string>
#include <vector>

#include "core/executive/motions.h"

namespace armloom {

// Finds changes of the arms' links.
class LinkWatch {
 public:
  struct Change {
    enum class Kind {
      waits,      // the controller has not connected yet; again when `detail` changes
      in_use,     // likewise: it serves another server
      connected,  // its first report has arrived
      lost,
      back,     // up again after it was lost
      stopped,  // the controller has stopped the arm without a command, while the link is up
    };
    ArmId arm;
    Kind kind;
    std::string detail;  // why the link is not up; empty if it is
  };
  explicit LinkWatch(std::size_t arms) : seen_(arms), details_(arms), stopped_(arms) {}

  // Returns the changes since the last call. A link that becomes stale, or recovers from that, is
  // no change.
  [[nodiscard]] std::vector<Change> look(const Motions& motions);

 private:
  enum class Seen { nothing, waiting, in_use, up, lost };
  std::vector<Seen> seen_;            // by ArmId
  std::vector<std::string> details_;  // by ArmId, in the last call
  std::vector<bool> stopped_;         // by ArmId: ArmLink::stopped_by_itself() in the last call
};

}  // namespace armloom
