#include "server/recording/idle_stretches.h"

#include <string>
#include <string_view>
#include <utility>

#include "server/recording/csv_text.h"

namespace armloom {
namespace {

constexpr std::string_view kHeader = "from_s,to_s";

tl::unexpected<Problems> fault(const std::filesystem::path& file, std::size_t line,
                               std::string detail, const std::string& found) {
  Problem problem{ProblemKind::invalid,
                  "bad-recording",
                  file.filename().string() + ":" + std::to_string(line),
                  std::move(detail),
                  {}};
  problem.value = found.substr(0, 80);
  return failure(std::move(problem));
}

}  // namespace

std::filesystem::path idle_file_of(const std::filesystem::path& states_file) {
  return states_file.parent_path() / (states_file.stem().string() + "_idle.csv");
}

IdleWriter::IdleWriter(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code ec;
  std::filesystem::remove(file_, ec);
}

// Flushes at once, so that a stretch is on disk before the next row of states.csv.
void IdleWriter::write(const IdleStretch& stretch) {
  std::string line;
  if (!out_.is_open()) {
    out_.open(file_, std::ios::binary);
    line.append(kHeader) += '\n';
  }
  append_seconds(line, stretch.from);
  line += ',';
  append_seconds(line, stretch.to);
  out_ << line << '\n';
  out_.flush();
}

Result<std::vector<IdleStretch>> read_idle_stretches(const std::filesystem::path& file) {
  std::vector<IdleStretch> stretches;
  std::error_code ec;
  if (!std::filesystem::exists(file, ec)) return stretches;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != kHeader) {
    return fault(file, 1, "expected the header " + std::string(kHeader), line);
  }
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const auto fields = split_fields(line);
    const auto from = read_number(fields.front());
    const auto to = fields.size() == 2 ? read_number(fields.back()) : std::nullopt;
    if (!from || !to) return fault(file, number, "expected two times in seconds", line);
    const IdleStretch stretch{at(from_seconds(*from)), at(from_seconds(*to))};
    const bool later = stretches.empty() || stretches.back().to <= stretch.from;
    if (stretch.to <= stretch.from || !later) {
      return fault(file, number, "times must increase", line);
    }
    stretches.push_back(stretch);
  }
  return stretches;
}

}  // namespace armloom
