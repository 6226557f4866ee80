#include "server/recording/states_csv.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "server/recording/csv_text.h"

namespace armloom {
namespace {

constexpr std::size_t kBuffer = 1U << 20U;

// While an arm moves, a recording has one row per control tick. If the gap between two rows is
// longer than kGapMax, the motion in the gap is unknown.
constexpr std::size_t kWarningsMax = 10;
constexpr Duration kGapMax = std::chrono::milliseconds(50);

// Returns the joint motion (rad or m) that is tolerated in an idle stretch.
double rest_tolerance(const Cell& cell) { return cell.checking.tracking_error_rad; }

// Reads states.csv line by line. Counts the lines, because problems name the line.
class StatesReader {
 public:
  StatesReader(const std::filesystem::path& file, const Cell& cell,
               std::vector<std::string>* warnings)
      : in_(file),
        name_(file.filename().string()),
        idle_file_(idle_file_of(file)),
        cell_(cell),
        warnings_(warnings) {}

  Result<std::vector<RecordedState>> read() {
    if (!in_) return fault("", "cannot be opened", {});
    if (!next_line()) return fault("", "the file is empty", {});
    if (auto bad = read_header()) return failure(std::move(*bad));
    auto idle = read_idle_stretches(idle_file_);
    if (!idle) return failure(std::move(idle.error()));
    idle_ = std::move(*idle);
    std::vector<RecordedState> states;
    while (next_line()) {
      if (in_.eof()) {
        warn("the last row has no line end: the recording was cut off there, the row is ignored");
        break;
      }
      RecordedState state{TimePoint{},
                          Configuration::Zero(static_cast<Eigen::Index>(cell_.joints.size()))};
      if (auto bad = read_row(state)) return failure(std::move(*bad));
      if (!states.empty() && state.time <= states.back().time) {
        return fault("time_s", "times must increase", std::string(split_fields(line_).front()));
      }
      if (!states.empty()) look_between(states.back(), state);
      states.push_back(std::move(state));
    }
    if (states.empty()) return fault("", "the file has a header but no rows", {});
    if (idle_next_ < idle_.size()) {
      warn("rows are missing: " + idle_file_.filename().string() + " continues");
    }
    return states;
  }

 private:
  // Warns of a gap between rows that is not recorded as idle, and of motion in an idle stretch.
  void look_between(const RecordedState& before, RecordedState& state) {
    while (idle_next_ < idle_.size() && idle_[idle_next_].to < state.time) {
      warn("rows of an idle stretch are missing before this row");
      ++idle_next_;
    }
    if (idle_next_ < idle_.size() && idle_[idle_next_] == IdleStretch{before.time, state.time}) {
      ++idle_next_;
      const double moved = (state.q - before.q).cwiseAbs().maxCoeff();
      state.after_rest = moved <= rest_tolerance(cell_);
      if (!state.after_rest) {
        warn("arms moved in a stretch recorded as idle: motion before this row is unknown");
      }
    } else if (state.time - before.time > kGapMax) {
      warn("more than 50 ms without a row: motion before this row is unknown");
    }
  }

  void warn(const std::string& what) const {
    if (warnings_ == nullptr || warnings_->size() >= kWarningsMax) return;
    warnings_->push_back(name_ + ":" + std::to_string(line_number_) + ": " + what);
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
    for (const std::string_view name : split_fields(line_)) columns_.emplace_back(name);
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
    const auto fields = split_fields(line_);
    if (fields.size() != columns_.size()) {
      return problem("",
                     "expected " + std::to_string(columns_.size()) + " fields, found " +
                         std::to_string(fields.size()),
                     line_);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto number = read_number(fields[i]);
      if (!number) {
        return problem(columns_[i], "expected a finite number",
                       fields[i].empty() ? "nothing" : fields[i]);
      }
      if (i == 0) {
        state.time = at(from_seconds(*number));
      } else {
        state.q[static_cast<Eigen::Index>(joints_[i - 1].index())] = *number;
      }
    }
    return std::nullopt;
  }

  std::ifstream in_;
  std::string name_;
  std::filesystem::path idle_file_;
  std::vector<IdleStretch> idle_;
  std::size_t idle_next_ = 0;
  const Cell& cell_;
  std::vector<std::string>* warnings_;
  std::string line_;
  std::size_t line_number_ = 0;
  std::vector<std::string> columns_;
  std::vector<JointId> joints_;  // joints of columns 1, 2, ...
};

}  // namespace

StatesWriter::StatesWriter(const std::filesystem::path& file, const Cell& cell)
    : out_(file, std::ios::binary), idle_(idle_file_of(file)), tolerance_(rest_tolerance(cell)) {
  buffer_.reserve(kBuffer + 4096);
  buffer_ = "time_s";
  for (const Joint& joint : cell.joints) buffer_ += "," + joint.name;
  buffer_ += '\n';
}

StatesWriter::~StatesWriter() { close(); }

bool StatesWriter::close() {
  if (!out_.is_open()) return good();
  catch_up();
  out_.close();
  return good();
}

void StatesWriter::write(TimePoint time, const Configuration& q) {
  const bool goes_on = at_rest_ && rest_from_ && q.size() == rest_q_.size() &&
                       (q - rest_q_).cwiseAbs().maxCoeff() <= tolerance_;
  if (goes_on) {
    rows_held_ += 1;
    held_at_ = time;
    held_q_ = q;
    return;
  }
  end_rest();
  if (at_rest_) {
    rest_from_ = time;
    rest_q_ = q;
  }
  append(time, q);
}

// Appends the last row of a stretch. Records the stretch if it has omitted rows.
void StatesWriter::end_rest() {
  if (rows_held_ > 1 || (rows_held_ > 0 && held_at_ - *rest_from_ > kGapMax)) {
    idle_.write({*rest_from_, held_at_});
  }
  if (rows_held_ > 0) append(held_at_, held_q_);
  rows_held_ = 0;
  rest_from_.reset();
}

void StatesWriter::catch_up() {
  end_rest();
  flush();
}

void StatesWriter::append(TimePoint time, const Configuration& q) {
  append_seconds(buffer_, time);
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
                                               std::vector<std::string>* warnings) {
  return StatesReader(file, cell, warnings).read();
}

Result<TrueStates> read_true_states(const std::filesystem::path& folder, const Cell& cell,
                                    std::vector<std::string>* warnings) {
  auto measured = read_states(folder / "states.csv", cell, warnings);
  if (!measured) return failure(std::move(measured.error()));
  TrueStates all{std::move(*measured), std::nullopt};
  if (!std::filesystem::exists(folder / kTrueStates)) return all;
  auto truth = read_states(folder / kTrueStates, cell, warnings);
  if (!truth) return failure(std::move(truth.error()));
  all.true_from = truth->front().time;
  std::erase_if(all.states,
                [&](const RecordedState& state) { return state.time >= *all.true_from; });
  all.states.insert(all.states.end(), std::make_move_iterator(truth->begin()),
                    std::make_move_iterator(truth->end()));
  return all;
}

}  // namespace armloom
