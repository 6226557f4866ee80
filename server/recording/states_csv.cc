#include "server/recording/states_csv.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace armloom {
namespace {

constexpr std::size_t kBuffer = 1U << 20U;
constexpr std::int64_t kNano = 1'000'000'000;

// A recording has one row per control tick. What happened in a longer hole cannot be audited.
constexpr std::size_t kDoubtsMax = 10;
constexpr Duration kGapMax = std::chrono::milliseconds(50);

// `nano` billionths as a decimal fraction with `decimals` (3 or 9) places.
void append_fraction(std::string& out, std::int64_t nano, int decimals) {
  char text[32];
  char* at = text;
  if (nano < 0) {
    *at++ = '-';
    nano = -nano;
  }
  at = std::to_chars(at, text + sizeof text, nano / kNano).ptr;
  *at++ = '.';
  std::int64_t rest = nano % kNano;
  std::int64_t unit = kNano / 10;
  for (int i = 0; i < decimals; ++i, unit /= 10) {
    *at++ = static_cast<char>('0' + rest / unit);
    rest %= unit;
  }
  out.append(text, static_cast<std::size_t>(at - text));
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

// Reads line after line and keeps the place for problems.
class StatesReader {
 public:
  StatesReader(const std::filesystem::path& file, const Cell& cell,
               std::vector<std::string>* doubts)
      : in_(file), name_(file.filename().string()), cell_(cell), doubts_(doubts) {}

  Result<std::vector<RecordedState>> read() {
    if (!in_) return fault("", "cannot be opened", {});
    if (!next_line()) return fault("", "the file is empty", {});
    if (auto bad = read_header()) return failure(std::move(*bad));
    std::vector<RecordedState> states;
    while (next_line()) {
      RecordedState state{TimePoint{},
                          Configuration::Zero(static_cast<Eigen::Index>(cell_.joints.size()))};
      if (auto bad = read_row(state)) return failure(std::move(*bad));
      if (!states.empty() && state.time <= states.back().time) {
        return fault("time_s", "times must increase", std::string(split(line_).front()));
      }
      if (!states.empty() && state.time - states.back().time > kGapMax) {
        doubt(
            "more than 50 ms without a row before this one: what happened in between is not known");
      }
      if (in_.eof()) doubt("the last row has no end of line and may be cut off");
      states.push_back(std::move(state));
    }
    if (states.empty()) return fault("", "there is no row of states", {});
    return states;
  }

 private:
  void doubt(const char* what) const {
    if (doubts_ == nullptr || doubts_->size() >= kDoubtsMax) return;
    doubts_->push_back(name_ + ":" + std::to_string(line_number_) + ": " + what);
  }

  bool next_line() {
    if (!std::getline(in_, line_)) return false;
    ++line_number_;
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    return true;
  }

  [[nodiscard]] Problem problem(std::string_view column, std::string detail,
                                std::string_view found) const {
    std::string place = name_;
    if (line_number_ > 0) place += ":" + std::to_string(line_number_);
    if (!column.empty()) place += " " + std::string(column);
    Problem problem{ProblemKind::invalid, "bad-recording", std::move(place), std::move(detail), {}};
    if (!found.empty()) problem.value = std::string(found.substr(0, 80));
    return problem;
  }
  [[nodiscard]] tl::unexpected<Problems> fault(std::string_view column, std::string detail,
                                               std::string_view found) const {
    return failure(problem(column, std::move(detail), found));
  }

  std::optional<Problem> read_header() {
    columns_.clear();
    for (const std::string_view name : split(line_)) columns_.emplace_back(name);
    if (columns_.front() != "time_s") {
      return problem("", "the first column must be time_s", columns_.front());
    }
    std::vector<bool> seen(cell_.joints.size(), false);
    for (std::size_t i = 1; i < columns_.size(); ++i) {
      const auto joint = cell_.find_joint(columns_[i]);
      if (!joint) return problem("", "no joint of the cell has this name", columns_[i]);
      if (seen[joint->index()]) return problem("", "the joint has two columns", columns_[i]);
      seen[joint->index()] = true;
      joints_.push_back(*joint);
    }
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (!seen[j]) return problem("", "the joint has no column: " + cell_.joints[j].name, {});
    }
    return std::nullopt;
  }

  std::optional<Problem> read_row(RecordedState& state) const {
    const auto fields = split(line_);
    if (fields.size() != columns_.size()) {
      return problem("",
                     "expected " + std::to_string(columns_.size()) + " fields, found " +
                         std::to_string(fields.size()),
                     line_);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double number = 0.0;
      const char* end = fields[i].data() + fields[i].size();
      const auto [stop, ec] = std::from_chars(fields[i].data(), end, number);
      if (ec != std::errc{} || stop != end || !std::isfinite(number) || std::abs(number) > 9e8) {
        return problem(columns_[i], "expected a finite number",
                       fields[i].empty() ? "nothing" : fields[i]);
      }
      if (i == 0) {
        state.time = at(from_seconds(number));
      } else {
        state.q[static_cast<Eigen::Index>(joints_[i - 1].index())] = number;
      }
    }
    return std::nullopt;
  }

  std::ifstream in_;
  std::string name_;
  const Cell& cell_;
  std::vector<std::string>* doubts_;
  std::string line_;
  std::size_t line_number_ = 0;
  std::vector<std::string> columns_;
  std::vector<JointId> joints_;  // of columns 1..
};

}  // namespace

StatesWriter::StatesWriter(const std::filesystem::path& file, const Cell& cell)
    : out_(file, std::ios::binary) {
  buffer_.reserve(kBuffer + 4096);
  buffer_ = "time_s";
  for (const Joint& joint : cell.joints) buffer_ += "," + joint.name;
  buffer_ += '\n';
}

StatesWriter::~StatesWriter() { flush(); }

void StatesWriter::write(TimePoint time, const Configuration& q) {
  const std::int64_t nano = time.time_since_epoch().count();
  append_fraction(buffer_, nano, nano % 1'000'000 == 0 ? 3 : 9);
  for (const double position : q) {
    buffer_ += ',';
    append_fraction(buffer_, std::llround(position * 1e9), 9);
  }
  buffer_ += '\n';
  if (buffer_.size() >= kBuffer) flush();
}

void StatesWriter::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  out_.flush();
  buffer_.clear();
}

Result<std::vector<RecordedState>> read_states(const std::filesystem::path& file, const Cell& cell,
                                               std::vector<std::string>* doubts) {
  return StatesReader(file, cell, doubts).read();
}

}  // namespace armloom
