#include "server/durable/damage.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace armloom {
namespace {

constexpr const char* kWhatToSeeTo =
    "; all arms are stopped. Waiting jobs may already have run: cancel those before you resume";

std::string sentence_of_jobs(const std::vector<std::string>& ids) {
  constexpr std::size_t kNamed = 10;  // listed; the rest are counted
  std::string named;
  for (std::size_t i = 0; i < std::min(kNamed, ids.size()); ++i) {
    named += (i == 0 ? "\"" : ", \"") + ids[i] + '"';
  }
  if (ids.size() > kNamed) named += " and " + std::to_string(ids.size() - kNamed) + " more";
  return "jobs that cannot be read or are damaged: " + named + "; they are not started";
}

}  // namespace

Alert alert_of(const Damage& damage) {
  std::vector<std::string> found;
  if (damage.is_behind) {
    found.push_back(
        std::string(
            "it holds less than the previous session wrote (its log armloom.db-wal is damaged, "
            "truncated or gone, or armloom.db is an older copy): the last jobs, changes and stops "
            "may be missing") +
        kWhatToSeeTo);
  }
  if (damage.is_unmarked) {
    found.push_back(
        std::string("armloom.mark is missing or unreadable, or armloom.db was copied without it: "
                    "the last jobs, changes and stops may be missing") +
        kWhatToSeeTo);
  }
  if (damage.lost_jobs > 0) {
    found.push_back("for " + std::to_string(damage.lost_jobs) +
                    (damage.lost_jobs == 1 ? " job" : " jobs") +
                    " only the client's request could be recovered; these are not started");
  }
  if (!damage.jobs.empty()) found.push_back(sentence_of_jobs(damage.jobs));
  if (damage.alerts + damage.audit > 0) {
    found.push_back(std::to_string(damage.alerts) + " alerts and " + std::to_string(damage.audit) +
                    " entries of the audit trail are damaged, and left out");
  }
  if (damage.stops) {
    found.push_back("the list of stopped arms is damaged: all arms are stopped until resumed");
  }
  std::string text = "the data folder is damaged: ";
  for (const std::string& one : found) text += (&one == &found.front() ? "" : "; ") + one;
  return {Alert::Level::error, text};
}

}  // namespace armloom
