#include "core/geometry/mesh/stl_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/geometry/mesh/mesh_words.h"

namespace armloom {
namespace {

constexpr std::size_t kHeader = 84;    // binary file: 80 bytes, then the count
constexpr std::size_t kTriangle = 50;  // 12 floats and two bytes

bool is(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

std::uint32_t count_of(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return count;
}

bool is_whole_binary(std::string_view bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * count_of(bytes);
}

// Binary headers may begin with "solid" too, but unprintable bytes follow.
bool is_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 1000);
  const bool prints = std::ranges::all_of(start, [](char c) { return c < 0 || c >= '\t'; });
  return prints && is(MeshWords(start).next(), "solid");
}

class StlText {
 public:
  explicit StlText(std::string_view text) : words_(text) {}

  // Returns false on an error.
  bool read() {
    while (true) {
      std::string_view word = words_.next();
      if (word.empty()) break;
      if (!is(word, "solid")) return stray(word, "'solid'");
      words_.skip_line();  // solid's name
      for (word = words_.next(); is(word, "facet"); word = words_.next()) {
        if (!read_facet()) return false;
      }
      if (!is(word, "endsolid")) return stray(word, "'facet' or 'endsolid'");
      words_.skip_line();
    }
    return true;
  }

  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] std::string binary() const {
    std::string bytes(kHeader - sizeof count_, ' ');
    bytes.append(reinterpret_cast<const char*>(&count_), sizeof count_);
    return bytes + facets_;
  }

 private:
  bool read_facet() {
    if (!expect("normal")) return false;
    // Skips the normal: some programs write -1.#IND here.
    for (int i = 0; i < 3; ++i) static_cast<void>(words_.next());
    if (!expect("outer") || !expect("loop")) return false;
    std::array<float, 12> facet{};
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      if (!expect("vertex") || !read_point()) return false;
      std::ranges::copy(point_, facet.begin() + static_cast<std::ptrdiff_t>(3 * corner));
    }
    const std::string_view end = words_.next();
    if (is(end, "vertex")) return fail("a facet has more than three corners: export triangles");
    if (!is(end, "endloop")) return stray(end, "'endloop'");
    if (!expect("endfacet")) return false;
    facets_.append(reinterpret_cast<const char*>(facet.data()), sizeof facet);
    facets_.append(2, '\0');
    ++count_;
    return true;
  }

  bool read_point() {
    for (float& number : point_) {
      const std::string_view word = words_.next();
      const auto read = float_of(word);
      if (!read) return stray(word, "a number");
      number = *read;
    }
    return true;
  }

  bool expect(const char* keyword) {
    const std::string_view word = words_.next();
    return is(word, keyword) || stray(word, "'" + std::string(keyword) + "'");
  }

  bool stray(std::string_view word, const std::string& due) {
    if (word.empty()) return fail("expected " + due + ", but the file ends: it was cut off");
    return fail("expected " + due + ", found " + quoted(word));
  }

  bool fail(const std::string& why) {
    error_ = "line " + std::to_string(words_.line()) + ": " + why;
    return false;
  }

  MeshWords words_;
  std::array<float, 3> point_{};
  std::uint32_t count_ = 0;
  std::string facets_;
  std::string error_;
};

std::string wrong_length(std::string_view bytes) {
  const std::string size = std::to_string(bytes.size()) + " bytes";
  if (bytes.size() < kHeader) {
    return "it is not an STL: it has " + size +
           " and does not begin with 'solid'; a binary STL has at least " +
           std::to_string(kHeader) + " bytes";
  }
  const std::size_t due = kHeader + kTriangle * count_of(bytes);
  return "its header announces " + std::to_string(count_of(bytes)) + " triangles (" +
         std::to_string(due) + " bytes), but it has " + size + ": it " +
         (bytes.size() < due ? "was cut off" : "holds more than it says") + ", or is not an STL";
}

}  // namespace

std::size_t triangles_of_stl(std::string_view binary) { return count_of(binary); }

tl::expected<std::string, std::string> read_stl(std::string bytes) {
  if (is_whole_binary(bytes)) return bytes;
  if (!is_text(bytes)) return tl::unexpected(wrong_length(bytes));
  StlText text(bytes);
  if (!text.read()) return tl::unexpected(text.error());
  return text.binary();
}

}  // namespace armloom
