#include "core/executive/signals.h"

#include <utility>

#include "core/base/nearest_name.h"
#include "core/executive/executive_input.h"

namespace armloom {
namespace {

SignalValue zero_of(SignalType type) {
  return type == SignalType::boolean ? SignalValue(false) : SignalValue(std::uint16_t{0});
}

SignalView at_start(const SignalDescription& signal, bool is_simulated) {
  SignalView view{.name = signal.name, .direction = signal.direction, .type = signal.value_type()};
  if (is_simulated) {
    view.value = signal.fail_state.value_or(signal.initial.value_or(zero_of(view.type)));
    view.is_connected = true;
  } else {
    view.device = signal.place->device;
    view.value = signal.fail_state;
    view.detail = "not connected yet";
  }
  return view;
}

}  // namespace

std::optional<Problem> find_bad_value(const IoDescription& io, const std::string& name,
                                      const SignalValue& value, ProblemKind unknown,
                                      const std::string& name_at, const std::string& value_at) {
  const auto id = io.find_signal(name);
  if (!id) {
    std::vector<std::string_view> names;
    for (const SignalDescription& signal : io.signals) names.emplace_back(signal.name);
    const auto near = nearest_name(name, names);
    return Problem{
        unknown, "unknown-signal", name_at,
        "the cell has no signal \"" + name + "\"" +
            (near ? "; did you mean " + std::string(*near) + "?" : ": GET /io lists them"),
        name};
  }
  const SignalType type = io.signal(*id).value_type();
  if (type_of(value) == type) return std::nullopt;
  const bool is_flag = type == SignalType::boolean;
  return Problem{ProblemKind::invalid, "wrong-type", value_at,
                 "signal " + name + " takes " +
                     (is_flag ? "true or false" : "a whole number from 0 to 65535") + ", found " +
                     text_of(value),
                 text_of(value)};
}

Signals::Signals(const IoDescription& io, Write write, Told told)
    : io_(io), write_(std::move(write)), told_(std::move(told)) {
  for (const SignalDescription& signal : io_.signals) {
    views_.push_back(at_start(signal, !signal.place || !write_));
  }
}

Result<SignalView> Signals::set(const std::string& name, const SignalValue& value) {
  return take(name, value, told_.asked({ExecutiveInput::SignalSet{name, value}}));
}

Result<SignalView> Signals::command(const std::string& name, const SignalValue& value) {
  return take(name, value, told_.now());
}

Result<SignalView> Signals::take(const std::string& name, const SignalValue& value, TimePoint now) {
  auto bad = find_bad_value(io_, name, value, ProblemKind::not_found, "", "/value");
  if (bad) return failure(*std::move(bad));
  const auto id = io_.find_signal(name);
  SignalView& view = views_[id->index()];
  if (!view.device.empty() && view.direction == SignalDirection::input) {
    return failure(Problem{ProblemKind::conflict, "input-of-device", "",
                           "input " + name + " is read from device " + view.device +
                               "; only outputs and simulated inputs can be set",
                           name});
  }
  if (!view.is_connected) {
    return failure(Problem{ProblemKind::unavailable, "device-not-connected", "",
                           "output " + name + " cannot be set: device " + view.device + ": " +
                               view.detail + "; GET /io tells when it is connected",
                           name});
  }
  if (!view.device.empty()) {
    write_(*id, value);
    view.commanded = value;
    told_.changed(*id);
  } else if (view.value != value) {
    view.value = value;
    view.changed_at = now;
    told_.changed(*id);
  }
  return view;
}

void Signals::report(const IoReport& report) {
  const TimePoint now = told_.asked({ExecutiveInput::IoReported{report}});
  if (!write_) return;
  for (std::uint32_t s = 0; s < views_.size(); ++s) {
    const SignalId id{s};
    if (views_[s].device != report.device || views_[s].device.empty()) continue;
    const auto read = report.values.find(views_[s].name);
    std::optional<SignalValue> value;
    if (!report.is_up) {
      value = io_.signal(id).fail_state;
    } else if (read != report.values.end() && type_of(read->second) == views_[s].type) {
      value = read->second;
    }
    see(id, value, report, now);
  }
}

void Signals::see(SignalId id, std::optional<SignalValue> value, const IoReport& report,
                  TimePoint now) {
  SignalView& view = views_[id.index()];
  const bool is_done = view.commanded && (!report.is_up || view.commanded == value);
  const bool is_news = is_done || view.value != value || view.is_connected != report.is_up ||
                       view.detail != report.detail;
  if (!is_news) return;
  if (view.value != value) view.changed_at = now;
  view.value = std::move(value);
  view.is_connected = report.is_up;
  view.detail = report.detail;
  if (is_done) view.commanded.reset();
  told_.changed(id);
}

}  // namespace armloom
