#include "server/durable/restart.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/executive/live_scene.h"
#include "core/model/payload.h"
#include "server/codec/json_text.h"
#include "server/codec/read_text.h"
#include "server/durable/damage.h"
#include "server/messages/arm.h"
#include "server/messages/job.h"
#include "server/messages/job_amendment.h"
#include "server/messages/job_request.h"
#include "server/messages/problem.h"
#include "server/messages/scene.h"
#include "server/messages/stored_scene.h"
#include "server/store/stored_object.h"

namespace armloom {
namespace {

struct ObjectNotPutBack {
  std::string name;
  std::string why;       // a sentence
  bool is_kept = false;  // its record stays in the store
};

Result<void> put_back(const StoredObject& stored, LiveScene& scene) {
  const bool is_there = has_object(scene.objects(), stored.name);
  if (!stored.text) return is_there ? scene.remove(stored.name) : Result<void>();
  auto place = read_place(*stored.text, scene.scene()->cell());
  if (!place) return failure(std::move(place.error()));
  if (*place && !(*place)->link.empty()) return scene.hold(**place);
  auto object = *place ? Result<CollisionObject>((*place)->object)
                       : read_object_text(*stored.text, stored.name);
  if (!object) return failure(std::move(object.error()));
  return is_there ? scene.replace(std::move(*object)) : scene.add(std::move(*object));
}

// Restores all objects in one edit, because one edit for each of thousands takes seconds. Returns
// false, with the scene unchanged, if an object cannot be restored.
bool put_back_at_once(const std::vector<LeftObject>& objects, LiveScene& scene) {
  std::vector<CollisionObject> all;
  for (const LeftObject& left : objects) {
    if (left.is_damaged || !left.object.text) return false;
    auto object = read_object_text(*left.object.text, left.object.name);
    if (!object) return false;
    all.push_back(std::move(*object));
  }
  return scene.set(std::move(all)).has_value();
}

// Restores the scene of the previous session and returns what could not be restored. Call it on the
// strand, before any arm moves.
std::vector<ObjectNotPutBack> put_back(std::vector<LeftObject> objects, LiveScene& scene) {
  // Removals of the cell file's objects, which come first.
  const auto kept = std::ranges::stable_partition(
      objects, [](const LeftObject& left) { return !left.object.text && !left.is_damaged; });
  const std::vector<LeftObject> set(kept.begin(), kept.end());
  if (set.size() > 1 && put_back_at_once(set, scene)) objects.erase(kept.begin(), kept.end());
  std::vector<ObjectNotPutBack> not_done;
  for (const LeftObject& left : objects) {
    const std::string what = "object \"" + left.object.name + "\" cannot be restored: ";
    if (left.is_damaged) {
      not_done.push_back({left.object.name, what + "its record in the data folder is damaged"});
    } else if (const auto done = put_back(left.object, scene); !done) {
      const Problem& problem = done.error().front();
      // An arm held it that is in another cell file: the next session may have that file again.
      const bool is_kept = problem.slug == "unknown-link";
      const std::string why = what + problem_sentence("", problem);
      not_done.push_back({left.object.name,
                          why + (is_kept ? "; its record is kept until you PUT or DELETE it" : ""),
                          is_kept});
    }
  }
  return not_done;
}

// Takes the time at which objects expire out of their records.
SceneExpiry take_expiry_of(std::vector<LeftObject>& objects, const WallClock& clock) {
  SceneExpiry expiry;
  std::vector<std::string> names;
  for (LeftObject& left : objects) {
    if (left.is_damaged || !left.object.text) continue;
    const auto expires_ms = take_expiry(*left.object.text);
    if (!expires_ms) continue;
    names.push_back(left.object.name);
    expiry.at = clock.time_at(WallClock::Wall(std::chrono::milliseconds(*expires_ms)));
  }
  std::ranges::sort(names);
  if (!names.empty()) {
    expiry.names = std::make_shared<const std::vector<std::string>>(std::move(names));
  }
  return expiry;
}

// Restores the speed overrides of the previous session. Returns what could not be restored: the
// records, each with the reason.
std::vector<std::pair<StoredSpeed, std::string>> put_back(const std::vector<LeftSpeed>& speeds,
                                                          const Cell& cell, Executive& executive) {
  std::vector<std::pair<StoredSpeed, std::string>> not_done;
  for (const auto& [speed, is_damaged] : speeds) {
    const auto arm = cell.find_arm(speed.arm);
    const std::string what = "the speed override of " +
                             (speed.arm.empty() ? "the cell" : "arm \"" + speed.arm + '"') +
                             " cannot be restored: ";
    const auto read = read_speed_override(*speed.text);
    if (is_damaged) {
      not_done.emplace_back(speed, what + "its record in the data folder is damaged");
    } else if (!read) {
      not_done.emplace_back(speed, what + problem_sentence("", read.error().front()));
    } else if (arm || speed.arm.empty()) {
      executive.set_speed(arm, read->share);
    }
  }
  return not_done;
}

// Returns the job's last published view. If the stored view is damaged and no longer JSON, returns
// a view that contains only the job's id.
nlohmann::ordered_json view_of(const StoredJob& job, const WallClock& clock) {
  auto view = nlohmann::ordered_json::parse(job.view, nullptr, false);
  if (view.is_object()) return view;
  const JobView nothing{.id = JobId{job.number}, .key = job.id};
  return nlohmann::ordered_json::parse(text_of(*job_format(), nothing, &clock), nullptr, false);
}

// Returns the job as last published, but ended at the start of this session.
StoredJob ended(StoredJob job, JobState state, Reason reason, const std::string& detail,
                const WallClock& clock) {
  const auto now = clock.wall_at(TimePoint{});
  job.state = to_string(state);
  job.has_ended = true;
  job.ended_ms = std::chrono::floor<std::chrono::milliseconds>(now).time_since_epoch().count();
  nlohmann::ordered_json view = view_of(job, clock);
  view["state"] = job.state;
  view["stopping"] = false;
  view["waits_on"] = nlohmann::ordered_json::array();
  view["cycle"] = nlohmann::ordered_json::array();
  view["ended_s"] = view["started_s"].is_null() ? view["submitted_s"] : view["started_s"];
  view["ended_at"] = clock.at(TimePoint{});
  view["result"] = {{"reason", to_string(reason)}, {"detail", detail}};
  if (view.contains("step")) view["result"]["step"] = view["step"];  // of a job with steps, from 0
  using nlohmann::ordered_json;
  job.view = view.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return job;
}

TimePoint submitted_at(const StoredJob& job, const WallClock& clock) {
  const std::chrono::milliseconds since_1970(job.submitted_ms.value_or(0));
  return clock.time_before(WallClock::Wall(since_1970));
}

}  // namespace

Result<Restart> Restart::prepare(JobKeeper& keeper) {
  const Leftover& left = keeper.store().leftover();
  Restart restart;
  restart.objects_ = left.objects;
  restart.expiry_ = take_expiry_of(restart.objects_, keeper.clock());
  restart.speeds_ = left.speeds;
  restart.stopped_arms_ = left.stopped_arms;
  restart.knows_stops_ =
      !left.stops_are_damaged && !left.stops_are_unwritten && !left.is_behind && !left.is_unmarked;
  restart.damage_ = {.lost_jobs = left.lost_jobs,
                     .stops = left.stops_are_damaged,
                     .is_behind = left.is_behind,
                     .is_unmarked = left.is_unmarked};
  for (const LeftJob& job : left.jobs) restart.sort_out(job, keeper);
  for (const WrittenOff& off : restart.written_off_) {
    keeper.store().see(ended(off.job, off.state, off.reason, off.detail, keeper.clock()));
  }
  if (!keeper.store().flush()) {
    const auto fault = keeper.store().fault();
    return failure(Problem{ProblemKind::unavailable, "cannot-write", "--data",
                           "the jobs in the data folder cannot be written: " +
                               (fault ? fault->text : std::string("unknown reason"))});
  }
  return restart;
}

bool Restart::failed_before(const JobRequest& request) const {
  return std::ranges::any_of(request.after,
                             [&](const std::string& id) { return ids_written_off_.contains(id); });
}

void Restart::write_off(const StoredJob& job, JobState state, Reason reason, std::string detail) {
  ids_written_off_.insert(job.id);
  written_off_.push_back({job, state, reason, std::move(detail)});
}

void Restart::write_off_unreadable(const StoredJob& job, std::string detail) {
  damage_.jobs.push_back(job.id);
  write_off(job, JobState::interrupted, Reason::server_restart, std::move(detail));
}

void Restart::sort_out(const LeftJob& left, const JobKeeper& keeper) {
  const StoredJob& job = left.job;
  constexpr auto kInterrupted = JobState::interrupted;
  constexpr auto kRestart = Reason::server_restart;
  if (left.is_damaged) {
    return write_off_unreadable(job, "its record in the data folder is damaged (wrong checksum)");
  }
  if (left.may_have_moved) {
    return write_off(job, kInterrupted, kRestart, "the server ended while the job was under way");
  }
  // A job of the server itself, or a job whose client got no answer: there is no request to run.
  if (!left.body)
    return write_off(job, kInterrupted, kRestart, "the server ended before the job began");
  auto read = read_job_submission(*left.body);
  if (!read) {
    return write_off_unreadable(
        job, "its request can no longer be read: " + problem_sentence("", read.error().front()));
  }
  JobRequest& request = read->request;
  if (left.amended) {
    const auto amendment = read_job_amendment(*left.amended);
    if (!amendment) {
      return write_off_unreadable(job, "its amendments can no longer be read: " +
                                           problem_sentence("", amendment.error().front()));
    }
    apply(*amendment, request);
  }
  request.key = job.id;
  request.body = std::make_shared<const std::string>(std::move(read->canonical));
  if (failed_before(request)) {
    return write_off(job, JobState::failed, Reason::predecessor_failed,
                     "a job that it comes after did not succeed");
  }
  for (const std::string& before : request.after) {
    if (ids_waiting_.contains(before)) continue;
    const auto found = keeper.history().find(before);  // nullopt if the store has deleted the job
    const bool has_succeeded =
        found && (!*found || (*found)->state == to_string(JobState::succeeded));
    if (!has_succeeded) {
      return write_off(job, JobState::failed, Reason::predecessor_failed,
                       "a job that it comes after did not succeed");
    }
    request.known.succeeded.push_back(before);
  }
  waiting_.push_back({JobId{job.number}, std::move(request), submitted_at(job, keeper.clock())});
  stored_.push_back(job);
  ids_waiting_.insert(job.id);
}

std::string Restart::summary() const {
  const auto counted = [](std::size_t count, const char* one, const char* more) {
    return std::to_string(count) + (count == 1 ? one : more);
  };
  std::string words =
      "the server was restarted: " + counted(stored_.size(), " job waits", " jobs wait");
  if (!written_off_.empty()) {
    words += ", " + counted(written_off_.size(), " was interrupted", " were interrupted");
  }
  return words + "; resume to continue";
}

void Restart::go_on(Executive& executive, const Cell& cell, JobKeeper& keeper) {
  if (!damage_.is_none()) executive.alert(alert_of(damage_));
  const auto not_set = put_back(speeds_, cell, executive);
  for (const auto& [speed, why] : not_set) {
    executive.alert({Alert::Level::error, why + "; it is 1: set it before you resume"});
    // Deletes the record. The alert reports it once.
    keeper.store().set_speed({.arm = speed.arm}, [](bool) {});
  }
  const auto not_put_back = put_back(objects_, executive.scene());
  if (expiry_.names) executive.scene().restore(expiry_);
  for (const ObjectNotPutBack& one : not_put_back) {
    executive.alert({Alert::Level::error, one.why});
    // Deletes the change from the store. The alert reports it once; the next session starts without
    // it.
    if (!one.is_kept) keeper.store().change({{.name = one.name}}, [](bool) {});
  }
  bool is_overloaded = false;
  for (std::uint32_t arm = 0; arm < cell.arms.size(); ++arm) {
    const auto overload = find_overload(cell, ArmId{arm}, executive.scene().scene()->attachments());
    if (!overload) continue;
    is_overloaded = true;
    executive.alert({Alert::Level::error,
                     "arm " + cell.arms[arm].name + " holds more than this cell file permits (" +
                         overload->detail + "). It does not move until it lets the object go: " +
                         "POST /scene/objects/NAME/detach"});
  }
  const bool asks = cell.scheduling.on_restart == OnRestart::ask;
  if (asks && (!waiting_.empty() || !written_off_.empty())) {
    stop_all(executive, summary());
  } else if (!not_put_back.empty()) {
    stop_all(executive, "the scene could not be restored after the server was restarted");
  } else if (is_overloaded) {
    stop_all(executive, "an arm holds more than the cell file permits");
  } else if (!not_set.empty()) {
    stop_all(executive, "a speed override could not be restored after the server was restarted");
  } else if (!knows_stops_) {
    stop_all(executive, "it is unknown which arms were stopped when the previous session ended");
  } else {
    std::vector<ArmId> arms;
    for (const std::string& name : stopped_arms_) {
      if (const auto arm = cell.find_arm(name)) arms.push_back(*arm);
    }
    if (!arms.empty()) executive.stop(arms, "stopped before the server was restarted");
  }
  const auto answers = executive.restore(std::move(waiting_));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i]) continue;
    const Problem& why = answers[i].error().front();
    const bool after = why.pointer.starts_with("/after");
    keeper.post([&keeper, off = WrittenOff{
                              stored_[i], after ? JobState::failed : JobState::interrupted,
                              after ? Reason::predecessor_failed : Reason::server_restart,
                              "the job no longer fits the cell: " + problem_sentence("", why)}] {
      keeper.store().see(ended(off.job, off.state, off.reason, off.detail, keeper.clock()));
    });
  }
}

}  // namespace armloom
