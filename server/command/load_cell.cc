#include <iostream>

#include "core/executive/executive.h"
#include "core/model/build_cell.h"
#include "core/model/cell_checks.h"
#include "server/codec/cell_codec.h"
#include "server/codec/problem_codec.h"
#include "server/command/command.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

// Nothing runs here: the executive is only built, to learn what it would refuse.
class NoJudges final : public JudgePool {
 public:
  void ask(Question, PlanningScenePtr, std::function<void(Verdict)>) override {}
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
};
class NoObserver final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

}  // namespace

void complain(const std::string& file, const Problems& problems) {
  for (const Problem& problem : problems) {
    std::cerr << "armloom: " << problem_sentence(file, problem) << '\n';
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
  LoadedCell loaded{nullptr, {}, cell_file, std::move(text)};
  auto description = read_cell_text(loaded.text, loaded.file.parent_path());
  if (!description) {
    complain(cell_file, description.error());
    return std::nullopt;
  }
  auto cell = build_cell(*description);
  if (!cell) {
    complain(cell_file, cell.error());
    return std::nullopt;
  }
  loaded.cell = std::move(*cell);
  loaded.description = std::move(*description);
  return loaded;
}

bool is_fit_to_run(const LoadedCell& loaded) {
  for (const Problems& doubts :
       {doubts_about_limits(loaded.description, *loaded.cell), doubts_about_meshes(*loaded.cell)}) {
    for (const Problem& doubt : doubts) {
      std::cerr << "armloom: warning: " << problem_sentence(loaded.file.string(), doubt) << '\n';
    }
  }
  NoJudges judges;
  NoObserver observer;
  const auto executive = Executive::create(loaded.cell, {}, judges, observer);
  if (!executive) complain(loaded.file.string(), executive.error());
  return executive.has_value();
}

}  // namespace armloom
