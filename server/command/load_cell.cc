#include <algorithm>
#include <iostream>
#include <limits>
#include <map>

#include "core/executive/claimed_pairs.h"
#include "core/executive/executive.h"
#include "core/model/cell/build_cell.h"
#include "core/model/cell/hazards.h"
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

// Returns the kind of a fault or warning, so that those of one kind can be told together. Two are
// of one kind if they have the same slug and are at the same sort of place: the same member of the
// cell file ("brake_rad_s2"), or the same element of a robot's file ("arm.urdf: link").
std::string kind_of(const Problem& problem) {
  const std::string& place = problem.pointer;
  if (place.starts_with('/')) return problem.slug + place.substr(place.rfind('/'));
  const std::size_t colon = place.find(": ");
  const std::string file = place.substr(0, place.find(':'));
  if (colon == place.npos) return problem.slug + " " + file;
  const std::string whose = place.substr(colon + 2);
  return problem.slug + " " + file + " " + whose.substr(0, whose.find(' '));
}

// Prints the first `lines` problems of each kind. The last line of a kind tells how many more there
// are.
void tell(const std::string& start, const std::string& file, const Problems& problems,
          std::size_t lines) {
  std::map<std::string, std::size_t> count;
  for (const Problem& problem : problems) ++count[kind_of(problem)];
  std::map<std::string, std::size_t> told;
  for (const Problem& problem : problems) {
    const std::string kind = kind_of(problem);
    if (told[kind] == lines) continue;
    std::cerr << "armloom: " << start << problem_sentence(file, problem);
    const std::size_t more = ++told[kind] == lines ? count[kind] - lines : 0;
    if (more > 0) {
      std::cerr << " [and " << more
                << " more of this kind; validate and import print them with --verbose]";
    }
    std::cerr << '\n';
  }
}

constexpr std::size_t kLinesOfProblems = 3;  // each may need its own remedy
constexpr std::size_t kLinesOfWarnings = 1;
constexpr std::size_t kAllLines = std::numeric_limits<std::size_t>::max();

}  // namespace

void complain(const std::string& file, const Problems& problems, Detail detail) {
  tell("", file, problems, detail == Detail::all ? kAllLines : kLinesOfProblems);
}

void warn(const std::string& file, const Problems& warnings, Detail detail) {
  const std::size_t lines = detail == Detail::all ? kAllLines : kLinesOfWarnings;
  Problems hazards;
  Problems others;
  for (const Problem& warning : warnings)
    (is_hazard(warning.slug) ? hazards : others).push_back(warning);
  tell("warning: hazard: ", file, hazards, lines);
  tell("warning: ", file, others, lines);
}

int refuse(const std::string& file, const Problems& problems, Detail detail) {
  complain(file, problems, detail);
  return kExitBadInput;
}

Problems said_of_option(Problems problems, std::string_view slug, std::string_view option) {
  for (Problem& problem : problems) {
    if (problem.slug == slug) problem.pointer = option;
  }
  return problems;
}

std::optional<LoadedCell> load_cell(const std::string& cell_file, Detail detail) {
  auto text = read_text_file(cell_file);
  if (!text) {
    complain(cell_file, text.error());
    return std::nullopt;
  }
  return load_cell_text(*std::move(text), cell_file, detail);
}

std::optional<LoadedCell> load_cell_text(std::string text, const std::string& cell_file,
                                         Detail detail) {
  LoadedCell loaded{nullptr, {}, cell_file, std::move(text), {}};
  Problems problems;
  loaded.description = read_cell_text(loaded.text, loaded.file.parent_path(), problems);
  auto cell = build_cell(loaded.description, loaded.warnings);
  if (!cell) add_what_is_independent(cell.error(), problems);
  if (!problems.empty()) {
    warn(cell_file, loaded.warnings, detail);
    complain(cell_file, problems, detail);
    return std::nullopt;
  }
  loaded.cell = *std::move(cell);
  return loaded;
}

bool is_fit_to_run(const LoadedCell& loaded, Detail detail) {
  warn(loaded.file.string(), loaded.warnings, detail);
  if (const auto claimed = report_claimed_pairs(loaded.cell)) {
    const std::string text = to_text(*claimed);
    if (!text.empty())
      std::cerr << "armloom: note: " << loaded.file.string() << ": " << text << '\n';
  }
  NoJudgements judges;
  NoObserver observer;
  const auto executive = Executive::create(loaded.cell, {}, judges, observer);
  if (!executive) complain(loaded.file.string(), executive.error(), detail);
  return executive.has_value();
}

}  // namespace armloom
