#include "core/model/mesh_file.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/model/dae_essence.h"
#include "core/model/mesh.h"
#include "core/model/mesh_bounds.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

CheckedMesh<std::string> read_bytes(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    return refuse_mesh(ProblemKind::not_found, "file-missing", "there is no such file", path);
  }
  if (!fs::is_regular_file(status)) {
    return refuse_mesh(ProblemKind::invalid, "file-unreadable", "it is not a regular file", path);
  }
  const auto size = fs::file_size(path, error);
  if (error)
    return refuse_mesh(ProblemKind::invalid, "file-unreadable", "its size is unknown", path);
  if (size > kMaxMeshBytes) {
    return refuse_mesh(ProblemKind::too_large, "mesh-too-large",
                       "it has " + std::to_string(size) + " bytes, at most " +
                           std::to_string(kMaxMeshBytes) + " are read",
                       static_cast<double>(size));
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    return refuse_mesh(ProblemKind::invalid, "file-unreadable", "it cannot be read", path);
  if (bytes.empty())
    return refuse_mesh(ProblemKind::invalid, "mesh-empty", "the file is empty", path);
  return bytes;
}

// ".5" is a number, but assimp's OBJ reader counts only words that begin with a digit or sign: a
// zero in front of the point. It also passes over lines that begin with a blank.
std::string as_assimp_reads_obj(const std::string& obj) {
  std::string text;
  text.reserve(obj.size() + obj.size() / 8);
  bool line_begins = true;
  bool vertex_line = false;
  for (const char c : obj) {
    const bool blank = c == ' ' || c == '\t';
    if (line_begins && blank) continue;
    if (line_begins) vertex_line = c == 'v';
    line_begins = c == '\n';
    const bool word_begins = !text.empty() && (text.back() == ' ' || text.back() == '\t');
    if (vertex_line && c == '.' && word_begins) text += '0';
    text += c;
  }
  return text;
}

// assimp takes what it understands of a text STL and passes over the rest, as of a file that was
// cut off: half a table. So each word has to be in its place.
CheckedMesh<void> check_text_stl(const std::string& stl) {
  static constexpr std::array<std::string_view, 21> kFacet{
      "facet",  "normal", "", "", "",       "outer", "loop", "vertex", "",        "",        "",
      "vertex", "",       "", "", "vertex", "",      "",     "",       "endloop", "endfacet"};
  if (!is_text_stl(stl)) return {};
  std::istringstream words(stl);
  std::string word;
  std::size_t facets = 0;
  const auto broken = [&](const std::string& what) {
    return refuse_mesh(ProblemKind::malformed, "mesh-unreadable",
                       "after " + std::to_string(facets) + " facets it " + what, word);
  };
  bool open = false;  // within solid ... endsolid
  while (words >> word) {
    if (word == "solid" || word == "endsolid") {
      if (open == (word == "solid")) return broken("has a '" + word + "' out of place");
      open = !open;
      std::getline(words, word);  // a name
      continue;
    }
    if (!open) return broken("has '" + word + "' outside of a solid");
    for (std::size_t i = 0; i < kFacet.size(); ++i) {
      if (i > 0 && !(words >> word)) return broken("ends in the middle of one: it was cut off");
      if (words.eof()) return broken("ends in the middle of one: it was cut off");
      if (!kFacet[i].empty() && word != kFacet[i])
        return broken("has '" + word + "' where '" + std::string(kFacet[i]) + "' should be");
    }
    ++facets;
  }
  if (open) return broken("ends without endsolid: it was cut off");
  return {};
}

CheckedMesh<void> check_binary_stl(const std::string& stl) {
  if (is_text_stl(stl)) return {};
  const std::size_t promised = 84 + std::size_t{50} * most_triangles_of_stl(stl);
  if (stl.size() >= promised) return {};
  return refuse_mesh(
      ProblemKind::malformed, "mesh-unreadable",
      "it is no STL, or was cut off: a text begins with 'solid', else bytes 81 to 84 are the "
      "number of triangles, and " +
          std::to_string((promised - 84) / 50) + " triangles take " + std::to_string(promised) +
          " bytes; it has " + std::to_string(stl.size()),
      static_cast<double>(stl.size()));
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".dae") return MeshFormat::dae;
  return std::nullopt;
}

CheckedMesh<std::string> read_mesh_bytes(const std::string& path, MeshFormat format) {
  auto bytes = read_bytes(path);
  if (!bytes) return bytes;
  std::size_t most = 0;
  if (format == MeshFormat::dae) {
    auto essence = read_dae_essence(*bytes);
    if (!essence) return refuse_mesh(ProblemKind::malformed, "mesh-unreadable", essence.error());
    most = essence->triangles;
    bytes = std::move(essence->text);
  } else {
    const auto whole = format == MeshFormat::stl ? check_binary_stl(*bytes) : CheckedMesh<void>{};
    if (!whole) return tl::unexpected(whole.error());
    most =
        format == MeshFormat::stl ? most_triangles_of_stl(*bytes) : most_triangles_of_obj(*bytes);
    if (format == MeshFormat::obj) bytes = as_assimp_reads_obj(*bytes);
  }
  if (most <= kMaxMeshTriangles) {
    if (format != MeshFormat::stl) return bytes;
    const auto sound = check_text_stl(*bytes);
    return sound ? std::move(bytes) : tl::unexpected(sound.error());
  }
  return refuse_mesh(ProblemKind::too_large, "mesh-too-large",
                     "it has " + std::to_string(most) + " triangles, at most " +
                         std::to_string(kMaxMeshTriangles) + " are read",
                     static_cast<double>(most));
}

}  // namespace armloom
