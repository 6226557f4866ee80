#include <iostream>

#include "core/model/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/codec/problem_codec.h"
#include "server/command/command.h"
#include "server/recording/recording.h"

namespace armloom {

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
  LoadedCell loaded{nullptr, {}, cell_file, {}};
  auto text = read_text_file(loaded.file);
  if (!text) {
    complain(cell_file, text.error());
    return std::nullopt;
  }
  loaded.text = std::move(*text);
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

}  // namespace armloom
