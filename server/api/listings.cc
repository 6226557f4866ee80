#include "server/api/listings.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "server/codec/read_text.h"

namespace armloom {
namespace {

constexpr int kNice = 10;
constexpr std::size_t kKeptAnyway = 1024;  // unused texts that are always kept

// Returns true if the job's text stays correct until the job changes. The wall time of a scheduled
// start may still change (WallClock).
bool is_written_for_good(const JobView& job) {
  return !job.times.scheduled_at || is_terminal(job.state);
}

}  // namespace

ListedJob JobTexts::of(const JobSheet::JobPtr& job, const WallClock& clock) {
  const auto write = [&] {
    return std::make_shared<const std::string>(text_of(*job_format(), *job, &clock));
  };
  if (!is_written_for_good(*job)) return write();
  Entry& entry = entries_[job->id.value()];
  if (entry.job != job) entry = {job, write(), entry.list};
  if (std::exchange(entry.list, list_) != list_) ++used_;
  return entry.text;
}

std::vector<ListedJob> JobTexts::of(const std::vector<JobSheet::JobPtr>& jobs,
                                    const WallClock& clock) {
  std::vector<ListedJob> texts;
  texts.reserve(jobs.size());
  for (const JobSheet::JobPtr& job : jobs) texts.push_back(of(job, clock));
  return texts;
}

void JobTexts::end_list() {
  if (entries_.size() > 2 * used_ + kKeptAnyway) {
    std::erase_if(entries_, [this](const auto& entry) { return entry.second.list != list_; });
  }
  ++list_;
  used_ = 0;
}

Listings::Listings(Post post) : post_(std::move(post)) {
  worker_.post(
      [] { static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice)); });
}

void Listings::write(Write write, std::function<void(std::string)> then) {
  worker_.post([this, write = std::move(write), then = std::move(then)] {
    auto text = std::make_shared<std::string>(write(texts_));
    texts_.end_list();
    post_([text = std::move(text), then] { then(std::move(*text)); });
  });
}

}  // namespace armloom
