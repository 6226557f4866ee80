#include "server/replay/input_format.h"

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>
#include <utility>
#include <variant>

#include "server/codec/io_format.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/codec/whole_format.h"
#include "server/drivers/arm_messages.h"
#include "server/messages/fault.h"
#include "server/messages/job_amendment.h"
#include "server/messages/scene.h"

namespace armloom {

using namespace formats;

namespace {

using In = ExecutiveInput;

// A job's body as the client sent it. A replay validates it again.
class BodyFormat final : public CustomFormat<std::shared_ptr<const std::string>> {
 public:
  using Body = std::shared_ptr<const std::string>;
  void read(const JsonNode& node, Body& out) const override {
    if (node.raw().is_null()) return node.invalid("no-body", "the body of a job is not logged");
    out = std::make_shared<const std::string>(node.raw().dump());
  }
  void write(JsonWriter& out, const Body& body) const override { out.raw(body ? *body : "null"); }
  Schema schema(Way) const override { return Schema::object(); }
};

PartPtr<In::AskedJob> asked_job_part() {
  return parts<In::AskedJob>({
      field("succeeded", &In::AskedJob::succeeded, list(text()), ""),
      always("body", &In::AskedJob::body, FormatPtr<BodyFormat::Body>(make_format<BodyFormat>())),
  });
}

template <class Input>
PartPtr<Input> jobs_part(ListSize size = {}) {
  return always("jobs", &Input::jobs,
                list(object<In::AskedJob>({asked_job_part()}), std::move(size)));
}

template <class T>
PartPtr<T> number_part(std::string_view key, JobId T::*where) {
  return always(
      key, where, whole(), "", [](JobId job) { return job.value(); },
      [](std::uint64_t number) { return JobId{number}; });
}

PartPtr<StepId> step_part() {
  return parts<StepId>({
      number_part("job", &StepId::job),
      omit_default("step", &StepId::index, 0, whole<std::uint32_t>(), "Index of the job's step"),
  });
}

template <class T>
PartPtr<T> nanoseconds_part(std::string_view key, TimePoint T::*where) {
  return always(
      key, where, whole<std::int64_t>(), "",
      [](TimePoint time) { return std::int64_t{time.time_since_epoch().count()}; },
      [](std::int64_t since) { return at(Duration(since)); });
}

FormatPtr<In::FormerJob> former_job_format() {
  return object<In::FormerJob>({
      number_part("number", &In::FormerJob::id),
      always("id", &In::FormerJob::key, text()),
      nanoseconds_part("submitted_ns", &In::FormerJob::submitted_at),
      always("amended", &In::FormerJob::amended, job_amendment_format()),
      inlined(&In::FormerJob::asked, asked_job_part()),
  });
}

// The object's format stores the rotation as angles, which do not read back to exactly the same
// matrix. So the matrix X_WO is stored, too, row by row.
template <class T>
PartPtr<T> matrix_part(std::string_view key, Eigen::Isometry3d T::*where) {
  using Rows = std::array<double, 12>;
  using Matrix = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const auto rows = [](const Eigen::Isometry3d& X_WO) {
    Rows all{};
    Eigen::Map<Matrix>(all.data()) = X_WO.matrix().topRows<3>();
    return all;
  };
  const auto pose = [](const Rows& all) {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.matrix().topRows<3>() = Eigen::Map<const Matrix>(all.data());
    return X_WO;
  };
  return always(key, where, numbers<12>(kAnyNumber), "", rows, pose);
}

FormatPtr<HeldView::Other> other_hand_format() {
  using Other = HeldView::Other;
  return object<Other>({
      always("link", &Other::link, text()),
      matrix_part("X_LO", &Other::X_LO),
  });
}

template <class Input>
PartPtr<Input> object_part() {
  return parts<Input>({
      always("object", &Input::object, object_format()),
      inlined(&Input::object, matrix_part("X_WO", &CollisionObject::X_WO)),
  });
}

// One object of a list, in the same form as object_part().
struct ListedObject {
  CollisionObject object;
};
PartPtr<In::ObjectsSet> objects_part() {
  const auto listed = object<ListedObject>({object_part<ListedObject>()});
  const auto wrapped = [](const std::shared_ptr<const std::vector<CollisionObject>>& objects) {
    std::vector<ListedObject> all;
    if (objects == nullptr) return all;  // not read yet
    for (const CollisionObject& object : *objects) all.push_back({object});
    return all;
  };
  const auto shared = [](std::vector<ListedObject> all) {
    std::vector<CollisionObject> objects;
    for (ListedObject& one : all) objects.push_back(std::move(one.object));
    return std::make_shared<const std::vector<CollisionObject>>(std::move(objects));
  };
  return parts<In::ObjectsSet>(
      {always("objects", &In::ObjectsSet::objects, list(listed), "", wrapped, shared),
       member<In::ObjectsSet>(
           {"expires_in_ns", "", Need::optional, {}}, whole<std::int64_t>(),
           [](const In::ObjectsSet& in) {
             return in.expires_in ? std::optional(std::int64_t{in.expires_in->count()})
                                  : std::nullopt;
           },
           [](In::ObjectsSet& in, std::int64_t ns) { in.expires_in = Duration(ns); })});
}

PartPtr<In::ExpiryRestored> expiry_part() {
  using Names = std::vector<std::string>;
  return parts<In::ExpiryRestored>({
      nanoseconds_part("at_ns", &In::ExpiryRestored::at),
      always(
          "objects", &In::ExpiryRestored::names, list(text()), "",
          [](const std::shared_ptr<const Names>& names) { return names ? *names : Names(); },
          [](Names names) { return std::make_shared<const Names>(std::move(names)); }),
  });
}

PartPtr<Alert> alert_part() {
  using Level = Alert::Level;
  return parts<Alert>({
      always(
          "level", &Alert::level, integer(0, static_cast<int>(Level::error)), "",
          [](Level level) { return static_cast<int>(level); },
          [](int number) { return static_cast<Level>(number); }),
      always("text", &Alert::text, text()),
  });
}

PartPtr<In::Reported> report_part() {
  return member<In::Reported>(
      {"report", "", Need::required, {}}, feedback_format(),
      [](const In::Reported& in) {
        return std::optional<FeedbackMessage>(message_of(in.feedback, in.arm));
      },
      [](In::Reported& in, const FeedbackMessage& message) {
        in = {message.arm, feedback_of(message)};
      });
}

PartPtr<ArmConnection> connection_part() {
  return parts<ArmConnection>({
      always("is_up", &ArmConnection::is_up, flag()),
      always("detail", &ArmConnection::detail, text()),
      always("number", &ArmConnection::number, whole()),
      always("is_in_use", &ArmConnection::is_in_use, flag()),
  });
}

PartPtr<IoReport> io_report_part() {
  return parts<IoReport>({
      always("device", &IoReport::device, text()),
      always("is_up", &IoReport::is_up, flag()),
      always("detail", &IoReport::detail, text()),
      always("values", &IoReport::values, dictionary(signal_value_format())),
      field("faults", &IoReport::faults, dictionary(text()), "By signal"),
  });
}

// Name and fields of an input.
template <class Input>
struct Kind {
  const char* name;
  PartList<Input> fields;
};
template <class>
struct KindOfEach;
template <class... Inputs>
struct KindOfEach<std::variant<Inputs...>> {
  using Table = std::tuple<Kind<Inputs>...>;
};

// The table of inputs, in the order of the variant.
KindOfEach<decltype(In::what)>::Table kinds() {
  using Waiting = Executive::Waiting;
  return {
      {"submit", {jobs_part<In::Submitted>({.fewest = 1, .most = 1})}},
      {"batch", {jobs_part<In::BatchOpened>()}},
      {"atomic_batch", {jobs_part<In::AtomicBatchOpened>()}},
      {"went_on", {}},
      {"restore", {always("jobs", &In::Restored::jobs, list(former_job_format()))}},
      {"cancel", {always("job", &In::Canceled::job, text())}},
      {"roll_back", {always("job", &In::RolledBack::job, text())}},
      {"hold",
       {always("job", &In::Held::job, text()), nanoseconds_part("until_ns", &In::Held::until)}},
      {"amend",
       {always("job", &In::Amended::job, text()),
        always("amendment", &In::Amended::amendment, job_amendment_format())}},
      {"replan", {always("job", &In::Replanned::job, text())}},
      {"stop",
       {always("arms", &In::Stopped::arms, list(text())),
        always("cause", &In::Stopped::cause, text()),
        always(
            "category", &In::Stopped::category, integer({0, 2}), "",
            [](StopCategory category) { return static_cast<int>(category); },
            [](int category) { return static_cast<StopCategory>(category); })}},
      {"resume", {always("arms", &In::Resumed::arms, list(text()))}},
      {"set_speed",
       {always("arm", &In::SpeedSet::arm, text(), "The cell if empty"),
        always("speed_override", &In::SpeedSet::share, number({0.0, 1.0}))}},
      {"change_policy", {always("policy", &In::PolicyChanged::policy, text())}},
      {"wind_down",
       {always("cause", &In::WoundDown::cause, text()),
        always(
            "keeps_waiting", &In::WoundDown::waiting, flag(), "",
            [](Waiting waiting) { return waiting == Waiting::is_kept; },
            [](bool kept) { return kept ? Waiting::is_kept : Waiting::ends; })}},
      {"add_object", {object_part<In::ObjectAdded>()}},
      {"replace_object", {object_part<In::ObjectReplaced>()}},
      {"remove_object", {always("object", &In::ObjectRemoved::name, text())}},
      {"set_objects", {objects_part()}},
      {"expire_objects", {always("objects", &In::ObjectsExpired::names, list(text()))}},
      {"restore_expiry", {expiry_part()}},
      {"hold_object",
       {object_part<In::ObjectHeld>(), always("link", &In::ObjectHeld::link, text()),
        field("shared_with", &In::ObjectHeld::shared_with, list(other_hand_format()),
              "Other hands")}},
      {"detach_object", {always("object", &In::ObjectDetached::object, text())}},
      {"inject", {always("fault", &In::Injected::fault, logged_fault_format())}},
      {"remove_fault", {always("fault", &In::FaultRemoved::fault, whole())}},
      {"alert", {inlined(&In::Alerted::alert, alert_part())}},
      {"judged",
       {always("evaluations", &In::Judged::evaluations, whole()),
        omit_default("interrupted", &In::Judged::interrupted, false, flag(),
                     "The check was ended early: its verdict is void")}},
      {"certified", {always("evaluations", &In::Certified::evaluations, whole())}},
      {"planned",
       {inlined(&In::Planned::step, step_part()),
        always("question", &In::Planned::question, whole())}},
      {"start_written", {inlined(&In::StartWritten::step, step_part())}},
      {"reported", {report_part()}},
      {"connected",
       {always("arm", &In::Connected::arm, text()),
        inlined(&In::Connected::connection, connection_part())}},
      {"set_signal",
       {always("signal", &In::SignalSet::signal, text()),
        always("value", &In::SignalSet::value, signal_value_format())}},
      {"io_reported", {inlined(&In::IoReported::report, io_report_part())}},
  };
}

constexpr const char* kNameKey = "input";

class LoggedInputFormat final : public CustomFormat<LoggedInput> {
 public:
  LoggedInputFormat() {
    std::apply([this](const auto&... kind) { (add(kind), ...); }, kinds());
  }
  void read(const JsonNode& node, LoggedInput& out) const override {
    if (!node.is_object()) return;
    node.required(kNameKey, [&](const JsonNode& named) {
      std::string name;
      if (!named.read(name)) return;
      const auto line = std::ranges::find(lines_, name, &Line::name);
      if (line != lines_.end()) return line->format->read(node, out);
      named.invalid("unknown-input", "unknown input \"" + name + "\"");
    });
  }
  void write(JsonWriter& out, const LoggedInput& logged) const override {
    lines_[logged.input.what.index()].format->write(out, logged);
  }
  Schema schema(Way way) const override {
    Schema all = Schema::array();
    for (const Line& line : lines_) all.push_back(line.format->schema(way));
    return {{"oneOf", std::move(all)}};
  }

 private:
  struct Line {
    std::string name;
    FormatPtr<LoggedInput> format;
  };
  template <class Input>
  void add(const Kind<Input>& kind) {
    const auto of_it = spelt<ExecutiveInput, Input>(
        kind.fields,
        [](const ExecutiveInput& input) -> const Input& { return std::get<Input>(input.what); },
        [](const Input& input) { return ExecutiveInput{input}; });
    lines_.push_back({kind.name, object<LoggedInput>({
                                     always("ticks", &LoggedInput::ticks, whole()),
                                     constant<LoggedInput>(kNameKey, kind.name),
                                     inlined(&LoggedInput::input, of_it),
                                 })});
  }
  std::vector<Line> lines_;  // by index of the alternative in the variant
};

}  // namespace

FormatPtr<InputLogHead> input_log_head_format() {
  using Head = InputLogHead;
  static const auto format = object<Head>({
      always("armloom_inputs", &Head::version, integer(Head::kVersion, Head::kVersion)),
      always("policy", &Head::policy, text()),
      always("seed", &Head::seed, whole()),
      always("first_job", &Head::first_job, whole()),
  });
  return format;
}

FormatPtr<LoggedInput> logged_input_format() {
  static const auto format = make_format<LoggedInputFormat>();
  return format;
}

}  // namespace armloom
