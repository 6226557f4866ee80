#include "server/replay/input_text.h"

#include "server/codec/json_writer.h"
#include "server/codec/read_text.h"
#include "server/messages/fault.h"
#include "server/messages/job_amendment.h"
#include "server/messages/scene.h"

namespace armloom {
namespace {

// Writes one input: its name, then what belongs to it.
class InputWriter {
 public:
  InputWriter(JsonWriter& out, const Cell& cell) : out_(out), cell_(cell) {}

  void operator()(const ExecutiveInput::Submitted& input) {
    using How = ExecutiveInput::Submitted::How;
    name(input.how == How::alone ? "submit" : input.how == How::batch ? "batch" : "atomic_batch");
    out_.key("jobs").begin_array();
    for (const JobRequest& job : input.requests) {
      out_.begin_object();
      asked_for(job);
      out_.end_object();
    }
    out_.end_array();
  }
  void operator()(const ExecutiveInput::WentOn&) { name("went_on"); }
  void operator()(const ExecutiveInput::Restored& input) {
    name("restore");
    out_.key("jobs").begin_array();
    for (const RestoredJob& job : input.jobs) {
      out_.begin_object().field("number", job.id.value()).field("id", job.request.key);
      out_.field("submitted_ns", job.submitted_at.time_since_epoch().count());
      const JobRequest& now = job.request;
      out_.key("amended").raw(
          text_of(*job_amendment_format(), JobAmendment{now.name, amendable(now.terms)}));
      asked_for(now);
      out_.end_object();
    }
    out_.end_array();
  }
  void operator()(const ExecutiveInput::Canceled& input) { name("cancel").field("job", input.job); }
  void operator()(const ExecutiveInput::Withdrawn& input) {
    name("withdraw").field("job", input.job);
  }
  void operator()(const ExecutiveInput::Held& input) {
    name("hold").field("job", input.job);
    out_.field("until_ns", input.until.time_since_epoch().count());
  }
  void operator()(const ExecutiveInput::Amended& input) {
    name("amend").field("job", input.job);
    out_.key("amendment").raw(text_of(*job_amendment_format(), input.amendment));
  }
  void operator()(const ExecutiveInput::Replanned& input) {
    name("replan").field("job", input.job);
  }
  void operator()(const ExecutiveInput::Stopped& input) {
    name("stop").field("arms", names(input.arms)).field("cause", input.cause);
  }
  void operator()(const ExecutiveInput::Resumed& input) {
    name("resume").field("arms", names(input.arms));
  }
  void operator()(const ExecutiveInput::PolicyChanged& input) {
    name("change_policy").field("policy", input.policy);
  }
  void operator()(const ExecutiveInput::WoundDown& input) {
    name("wind_down").field("cause", input.cause);
    out_.field("keeps_waiting", input.waiting == Executive::Waiting::is_kept);
  }
  void operator()(const ExecutiveInput::ObjectAdded& input) {
    name("add_object");
    object(input.object);
  }
  void operator()(const ExecutiveInput::ObjectReplaced& input) {
    name("replace_object");
    object(input.object);
  }
  void operator()(const ExecutiveInput::ObjectRemoved& input) {
    name("remove_object").field("object", input.name);
  }
  void operator()(const ExecutiveInput::Injected& input) {
    name("inject").key("fault").raw(text_of(*fault_format(), FaultView{0, input.fault}));
  }
  void operator()(const ExecutiveInput::FaultRemoved& input) {
    name("remove_fault").field("fault", input.fault);
  }
  void operator()(const ExecutiveInput::Alerted& input) {
    name("alert").field("level", static_cast<int>(input.alert.level));
    out_.field("text", input.alert.text);
  }
  void operator()(const ExecutiveInput::Judged& input) {
    name("judged").field("evaluations", input.evaluations);
  }
  void operator()(const ExecutiveInput::Planned& input) {
    name("planned").field("job", input.job.value()).field("question", input.question);
  }
  void operator()(const ExecutiveInput::StartWritten& input) {
    name("start_written").field("job", input.job.value());
  }

 private:
  JsonWriter& name(const char* name) { return out_.field("input", name); }
  // In the client's words, as everything is validated anew.
  void asked_for(const JobRequest& job) {
    if (!job.known.succeeded.empty()) out_.field("succeeded", job.known.succeeded);
    out_.key("body").raw(job.body ? *job.body : "null");
  }
  [[nodiscard]] std::vector<std::string> names(const std::vector<ArmId>& arms) const {
    std::vector<std::string> names;
    for (ArmId arm : arms) names.push_back(cell_.arm(arm).name);
    return names;
  }
  // Angles do not read back to the same matrix: that stands beside them.
  void object(const CollisionObject& object) {
    out_.key("object").raw(text_of(*object_format(), object));
    std::vector<double> rows;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        rows.push_back(object.X_WO.matrix()(row, column));
      }
    }
    out_.field("X_WO", rows);
  }

  JsonWriter& out_;
  const Cell& cell_;
};

}  // namespace

std::string head_text(const InputLogHead& head) {
  JsonWriter out;
  out.begin_object().field("armloom_inputs", InputLogHead::kVersion).field("policy", head.policy);
  out.field("seed", head.seed).field("first_job", head.first_job).end_object();
  return out.take();
}

std::string input_text(std::uint64_t ticks, const ExecutiveInput& input, const Cell& cell) {
  JsonWriter out;
  out.begin_object().field("ticks", ticks);
  std::visit(InputWriter(out, cell), input.what);
  out.end_object();
  return out.take();
}

}  // namespace armloom
