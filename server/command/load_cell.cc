#include <algorithm>
#include <iostream>

#include "core/executive/claimed_pairs.h"
#include "core/executive/executive.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/command/command.h"
#include "server/messages/problem.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

// Does nothing. It serves an executive that is created only to learn what it would refuse.
class NoJudgements final : public JudgementService {
 public:
  void ask(Question, PlanningScenePtr, std::function<void(Verdict)>) override {}
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  void plan(PlanTask) override {}
  bool draft(PlanTask) override { return false; }
};
class NoObserver final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

bool is_at_or_below(const std::string& pointer, const std::string& above) {
  return pointer.starts_with(above) &&
         (pointer.size() == above.size() || pointer[above.size()] == '/');
}

// Adds problems of building the cell to `problems`, the faults of the file. Omits those that may be
// a consequence of these faults.
void add_what_is_independent(const Problems& found, Problems& problems) {
  const Problems faults = problems;
  for (const Problem& problem : found) {
    const bool follows = std::any_of(faults.begin(), faults.end(), [&](const Problem& fault) {
      // If the JSON is malformed, nothing was read, so every problem may follow from that.
      return fault.slug == "malformed-json" || fault.slug == "duplicate-key" ||
             fault.pointer.empty() || fault.pointer.front() != '/' ||
             is_at_or_below(problem.pointer, fault.pointer) ||
             is_at_or_below(fault.pointer, problem.pointer);
    });
    if (!follows) problems.push_back(problem);
  }
}

}  // namespace

void complain(const std::string& file, const Problems& problems) {
  for (const Problem& problem : problems) {
    std::cerr << "armloom: " << problem_sentence(file, problem) << '\n';
  }
}

void warn(const std::string& file, const Problems& warnings) {
  for (const Problem& warning : warnings) {
    std::cerr << "armloom: warning: " << problem_sentence(file, warning) << '\n';
  }
}

int refuse(const std::string& file, const Problems& problems) {
  complain(file, problems);
  return kExitBadInput;
}

Problems said_of_option(Problems problems, std::string_view slug, std::string_view option) {
  for (Problem& problem : problems) {
    if (problem.slug == slug) problem.pointer = option;
  }
  return problems;
}

std::optional<LoadedCell> load_cell(const std::string& cell_file) {
  auto text = read_text_file(cell_file);
  if (!text) {
    complain(cell_file, text.error());
    return std::nullopt;
  }
  return load_cell_text(*std::move(text), cell_file);
}

std::optional<LoadedCell> load_cell_text(std::string text, const std::string& cell_file) {
  LoadedCell loaded{nullptr, {}, cell_file, std::move(text), {}};
  Problems problems;
  loaded.description = read_cell_text(loaded.text, loaded.file.parent_path(), problems);
  auto cell = build_cell(loaded.description, loaded.warnings);
  if (!cell) add_what_is_independent(cell.error(), problems);
  if (!problems.empty()) {
    complain(cell_file, problems);
    warn(cell_file, loaded.warnings);
    return std::nullopt;
  }
  loaded.cell = *std::move(cell);
  return loaded;
}

bool is_fit_to_run(const LoadedCell& loaded) {
  warn(loaded.file.string(), loaded.warnings);
  if (const auto claimed = report_claimed_pairs(loaded.cell)) {
    const std::string text = to_text(*claimed);
    if (!text.empty())
      std::cerr << "armloom: note: " << loaded.file.string() << ": " << text << '\n';
  }
  NoJudgements judges;
  NoObserver observer;
  const auto executive = Executive::create(loaded.cell, {}, judges, observer);
  if (!executive) complain(loaded.file.string(), executive.error());
  return executive.has_value();
}

}  // namespace armloom
