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
  bool is_known = false;
  for (std::uint32_t s = 0; s < views_.size(); ++s) {
    const SignalId id{s};
    const std::string& name = views_[s].name;
    if (views_[s].device != report.device || views_[s].device.empty()) continue;
    is_known = true;
    if (!report.is_up) {
      see(id, {io_.signal(id).fail_state, false, report.detail}, now);
    } else if (const auto fault = report.faults.find(name); fault != report.faults.end()) {
      see(id, {std::nullopt, false, fault->second}, now);
      tell_refusal(report, name, fault->second);
    } else {
      const auto read = report.values.find(name);
      const bool fits = read != report.values.end() && type_of(read->second) == views_[s].type;
      see(id, {fits ? std::optional(read->second) : std::nullopt, true, ""}, now);
    }
  }
  if (is_known) tell_device(report);
}

void Signals::tell_device(const IoReport& report) {
  if (report.is_up) {
    if (lost_.erase(report.device) == 0) return;
    told_.alert({Alert::Level::info, "I/O device " + report.device + " is connected"});
  } else if (lost_.insert(report.device).second) {
    std::erase_if(told_refusals_, [&](const auto& told) {
      return views_[io_.find_signal(told.first)->index()].device == report.device;
    });
    told_.alert({Alert::Level::error, "I/O device " + report.device +
                                          " is not connected: " + report.detail +
                                          "; its inputs have no value, and jobs wait for them"});
  }
}

// Reports a repeated refusal once, for example if a step sets its output again.
void Signals::tell_refusal(const IoReport& report, const std::string& signal,
                           const std::string& why) {
  std::string& told = told_refusals_[signal];
  if (told == why) return;
  told = why;
  told_.alert({Alert::Level::error, "I/O device " + report.device + " refuses signal " + signal +
                                        ": " + why + "; check its table, address and value"});
}

void Signals::see(SignalId id, Seen seen, TimePoint now) {
  SignalView& view = views_[id.index()];
  const bool is_done = view.commanded && (!seen.is_connected || view.commanded == seen.value);
  const bool is_news = is_done || view.value != seen.value ||
                       view.is_connected != seen.is_connected || view.detail != seen.detail;
  if (!is_news) return;
  if (view.value != seen.value) view.changed_at = now;
  view.value = std::move(seen.value);
  view.is_connected = seen.is_connected;
  view.detail = std::move(seen.detail);
  if (is_done) view.commanded.reset();
  told_.changed(id);
}

}  // namespace armloom
