#include "server/durable/damaged_jobs.h"

#include <algorithm>
#include <cstddef>

namespace armloom {

Alert alert_of_damaged(const std::vector<std::string>& ids) {
  constexpr std::size_t kNamed = 10;  // what is left of a sentence
  std::string named;
  for (std::size_t i = 0; i < std::min(kNamed, ids.size()); ++i) {
    named += (i == 0 ? "\"" : ", \"") + ids[i] + '"';
  }
  if (ids.size() > kNamed) named += " and " + std::to_string(ids.size() - kNamed) + " more";
  return {
      Alert::Level::error,
      "the data folder is damaged: jobs that cannot be read, or are not as they were written: " +
          named + "; none of them is begun"};
}

}  // namespace armloom
