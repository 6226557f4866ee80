#include "server/codec/cell_codec.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/cell_format.h"
#include "server/codec/json_text.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::string resolved(const std::string& path, const fs::path& folder) {
  return (fs::path(path).is_absolute() ? fs::path(path) : folder / path)
      .lexically_normal()
      .string();
}

}  // namespace

Result<CellDescription> read_cell_text(std::string_view text, const fs::path& folder) {
  Problems faults;
  CellDescription cell = read_cell_text(text, folder, faults);
  if (!faults.empty()) return failure(std::move(faults));
  return cell;
}

CellDescription read_cell_text(std::string_view text, const fs::path& folder, Problems& faults) {
  CellDescription cell;
  auto file = parse_json(text, JsonComments::allowed);
  if (!file) {
    faults = file.error();
    return cell;
  }
  cell_format().map_paths(*file, [&](const std::string& path) { return resolved(path, folder); });
  cell_format().read(JsonNode(*file, "", faults), cell);
  return cell;
}

std::string with_cell_paths(std::string_view text, const fs::path& folder,
                            const std::function<std::string(const fs::path&)>& path_of) {
  auto file = parse_json(text, JsonComments::allowed);
  if (!file) return std::string(text);
  cell_format().map_paths(*file,
                          [&](const std::string& path) { return path_of(resolved(path, folder)); });
  return file->dump(2) + "\n";
}

}  // namespace armloom
