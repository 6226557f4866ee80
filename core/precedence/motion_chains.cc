#include "core/precedence/motion_chains.h"

#include <algorithm>
#include <map>

namespace armloom {

MotionChains::MotionChains(const std::vector<CoordinatedMotion>& motions)
    : before_(motions.size()), stands_(motions.size(), true), moves_on_(motions.size(), false) {
  std::map<ArmId, std::size_t> last;
  std::vector<std::size_t> followed(motions.size(), 0);  // how many of its arms move on
  for (std::size_t m = 0; m < motions.size(); ++m) {
    std::size_t preceded = 0;
    for (const ArmId arm : motions[m].arms) {
      if (const auto ahead = last.find(arm); ahead != last.end()) {
        ++preceded;
        ++followed[ahead->second];
        if (std::ranges::find(before_[m], ahead->second) == before_[m].end()) {
          before_[m].push_back(ahead->second);
        }
      }
      last[arm] = m;
    }
    stands_[m] = preceded < motions[m].arms.size();
  }
  for (std::size_t m = 0; m < motions.size(); ++m) {
    moves_on_[m] = followed[m] == motions[m].arms.size();
  }
}

}  // namespace armloom
