#include "core/executive/job_register.h"

#include <algorithm>
#include <utility>

namespace armloom {

void JobRegister::add(JobId id, JobLabel label) {
  ids_.emplace(label.key, id);
  active_bytes_ += label.bytes;
  labels_.emplace(id, std::move(label));
}

void JobRegister::rename(JobId id, std::string name) { labels_.at(id).name = std::move(name); }

std::vector<JobRegister::Forgotten> JobRegister::end(JobId id) {
  ended_.push_back(id);
  labels_.at(id).has_ended = true;
  active_bytes_ -= labels_.at(id).bytes;
  ended_bytes_ += labels_.at(id).bytes;
  std::vector<Forgotten> forgotten;
  while (ended_.size() > ended_max_.jobs ||
         (ended_.size() > 1 && ended_bytes_ > ended_max_.bytes)) {
    const JobId oldest = ended_.front();
    ended_.pop_front();
    forgotten.push_back({oldest, key(oldest)});
    take_out(oldest);
  }
  return forgotten;
}

bool JobRegister::has_ended(JobId id) const {
  const auto label = labels_.find(id);
  return label != labels_.end() && label->second.has_ended;
}

void JobRegister::forget(JobId id) {
  if (std::erase(ended_, id) > 0) take_out(id);
}

void JobRegister::take_out(JobId id) {
  ended_bytes_ -= labels_.at(id).bytes;
  ids_.erase(labels_.at(id).key);
  labels_.erase(id);
}

std::optional<JobId> JobRegister::find(const std::string& key) const {
  const auto found = ids_.find(key);
  return found == ids_.end() ? std::nullopt : std::optional(found->second);
}

const JobLabel* JobRegister::label(JobId id) const {
  const auto found = labels_.find(tasks_.told(id));
  return found == labels_.end() ? nullptr : &found->second;
}

std::string JobRegister::free_key(JobId id) const {
  const std::string base = "job-" + std::to_string(id.value());
  std::string key = base;
  for (int n = 2; is_taken(key); ++n) key = base + "." + std::to_string(n);
  return key;
}

std::string JobRegister::own_key(OwnJob kind) {
  const std::string begins = kind == OwnJob::move_to_start ? "move-to-start-" : "retreat-";
  std::uint64_t& next = next_own_[static_cast<std::size_t>(kind)];
  std::string own;
  do {
    own = begins + std::to_string(next++);
  } while (is_taken(own));
  return own;
}

std::string JobRegister::key(JobId job) const {
  const JobLabel* known = label(job);
  return known == nullptr ? std::string() : known->key;
}

std::string JobRegister::name(JobId job) const {
  const JobLabel* known = label(job);
  return known == nullptr ? std::string() : known->name;
}

JobState JobRegister::state(JobId id) const {
  const Task* task = tasks_.find(id);
  return task == nullptr ? scheduler_.find(id)->state() : state_of(*task, scheduler_);
}

bool JobRegister::has_job(ArmId arm) const { return scheduler_.head(arm).has_value(); }

Result<JobId> JobRegister::not_ended(const std::string& key) const {
  const auto id = find(key);
  if (!id) {
    return failure(Problem{ProblemKind::not_found, "no-such-job", "request target",
                           "there is no job \"" + key + "\"", key});
  }
  const JobState state = this->state(*id);
  if (is_terminal(state)) {
    return failure(Problem{
        ProblemKind::conflict, "job-has-ended", "",
        "job \"" + key + "\" has ended: " + to_string(state) + "; post it again under another id",
        key});
  }
  return *id;
}

}  // namespace armloom
