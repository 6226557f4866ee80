#include "core/geometry/mesh/obj_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/mesh/mesh_words.h"

namespace armloom {
namespace {

using Error = std::optional<std::string>;

// Keywords without effect on the surface.
constexpr std::array<std::string_view, 20> kPassedOver = {
    "vt",     "vn",       "vp",       "o",          "g",         "s", "mg",
    "usemtl", "mtllib",   "usemap",   "maplib",     "lod",       "l", "p",
    "bevel",  "c_interp", "d_interp", "shadow_obj", "trace_obj", ""};
constexpr std::array<std::string_view, 26> kFreeForm = {
    "cstype", "deg",  "bmat", "step", "curv", "curv2",  "surf",  "parm",  "trim",
    "hole",   "scrv", "sp",   "end",  "con",  "call",   "csh",   "ctech", "stech",
    "bzp",    "bsp",  "cdc",  "cdp",  "res",  "cdcurv", "merge", "sharp"};

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

class ObjReader {
 public:
  ObjText out{{}, 0};

  Error read(const std::vector<std::string_view>& words, std::size_t line) {
    const std::string_view first = words.front();
    if (first == "v") return read_vertex(words);
    if (first == "f" || first == "fo") return read_face(words, line);
    if (is_one_of(first, kPassedOver)) return std::nullopt;
    if (is_one_of(first, kFreeForm)) {
      return quoted(first) +
             " belongs to a free-form surface, which is not supported: export triangles";
    }
    return quoted(first) + " is not an OBJ keyword";
  }

  // Checks the largest vertex index of all faces. This is possible only at the end of the file,
  // because faces may use vertices that come later.
  [[nodiscard]] Error at_end() const {
    if (largest_ <= vertices_) return std::nullopt;
    return "line " + std::to_string(largest_line_) + ": a face names vertex " +
           std::to_string(largest_) + ", but the file has " + std::to_string(vertices_) +
           " vertices: was it cut off?";
  }

 private:
  Error read_vertex(const std::vector<std::string_view>& words) {
    const std::size_t numbers = words.size() - 1;
    if (numbers != 3 && numbers != 4 && numbers != 6 && numbers != 7) {
      return "a vertex has " + std::to_string(numbers) + " numbers, not 3";
    }
    out.text += 'v';
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto number = float_of(words[i]);
      if (!number) return quoted(words[i]) + " is not a number";
      if (i <= 3 || numbers == 4) add(*number);  // other numbers are a color
    }
    out.text += '\n';
    ++vertices_;
    return std::nullopt;
  }

  Error read_face(const std::vector<std::string_view>& words, std::size_t line) {
    const std::size_t corners = words.size() - 1;
    if (corners < 3) return "a face has " + std::to_string(corners) + " corners, not 3 or more";
    out.text += 'f';
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto index = index_of(words[i]);
      if (!index || *index == 0) return quoted(words[i]) + " is not a corner of a face";
      if (*index > largest_) {
        largest_ = *index;
        largest_line_ = line;
      }
      if (*index < 0 && -*index > vertices_) {
        return quoted(words[i]) + " counts back beyond the first vertex";
      }
      add(*index > 0 ? *index : vertices_ + 1 + *index);
    }
    out.text += '\n';
    out.triangles += corners - 2;
    return std::nullopt;
  }

  void add(auto number) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    out.text += ' ';
    out.text.append(digits.begin(), end);
  }

  // Returns the vertex index of v, v/vt, v//vn or v/vt/vn.
  static std::optional<long long> index_of(std::string_view word) {
    std::optional<long long> vertex;
    for (int part = 0; part < 3; ++part) {
      const std::string_view text = word.substr(0, word.find('/'));
      long long index = 0;
      const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), index);
      const bool number = error == std::errc{} && at == text.data() + text.size();
      if (!number && (part == 0 || !text.empty())) return std::nullopt;
      if (part == 0) vertex = index;
      if (text.size() == word.size()) return vertex;
      word.remove_prefix(text.size() + 1);
    }
    return std::nullopt;
  }

  long long vertices_ = 0;
  long long largest_ = 0;
  std::size_t largest_line_ = 0;
};

}  // namespace

tl::expected<ObjText, std::string> read_obj(std::string_view bytes) {
  ObjReader reader;
  std::vector<std::string_view> words;
  std::size_t line = 0;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    MeshWords read(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    ++line;
    bool goes_on = false;
    for (auto word = read.next(); !word.empty() && word.front() != '#'; word = read.next()) {
      goes_on = word.ends_with('\\');
      if (goes_on) word.remove_suffix(1);
      if (!word.empty()) words.push_back(word);
    }
    if (words.empty() || (goes_on && !bytes.empty())) continue;
    if (const Error error = reader.read(words, line)) {
      return tl::unexpected("line " + std::to_string(line) + ": " + *error);
    }
    words.clear();
  }
  if (const Error error = reader.at_end()) return tl::unexpected(*error);
  return std::move(reader.out);
}

}  // namespace armloom
