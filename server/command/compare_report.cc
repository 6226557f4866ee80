#include "server/command/compare_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "server/command/xml_escaped.h"

namespace armloom {
namespace {

std::string fixed(double number, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  return text;
}
std::string seconds(Duration time, int decimals) { return fixed(to_seconds(time), decimals); }

std::optional<double> share(Duration part, const ComparedRun& run) {
  const auto whole = run.makespan();
  if (!whole) return std::nullopt;
  return to_seconds(part) / to_seconds(*whole);
}
std::string percent(std::optional<double> ratio) {
  return ratio ? fixed(100.0 * *ratio, 1) + " %" : "-";
}

std::size_t jobs_run(const Comparison& comparison) {
  return std::max<std::size_t>(comparison.jobs, 1);
}

// Returns, for example, "1 expired, 2 refused".
std::string other_ends(const RunSummary& summary) {
  std::string text;
  for (const auto& [state, count] : summary.jobs) {
    if (count == 0 || state == to_string(JobState::succeeded)) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + state;
  }
  return text.empty() ? "-" : text;
}

// ---- Markdown ----

std::string in_a_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '\\') escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
}

// Returns the number of code points, roughly the width.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

using Row = std::vector<std::string>;

Row heading(const Comparison& comparison) {
  Row row = {"policy", "succeeded", "other ends", "makespan, s"};
  row.push_back(comparison.busiest.empty()
                    ? "busiest arm's work"
                    : "busiest arm's work (" + in_a_cell(comparison.busiest) + ", " +
                          seconds(comparison.busiest_work, 2) + " s)");
  for (const std::string& arm : comparison.arms) row.push_back(in_a_cell(arm) + " moves");
  for (const char* name :
       {"two or more arms move", "mean wait, s", "longest wait, s", "smallest clearance, mm",
        "monitor stops", "checks", "checking, ms per job", "wall time, s"}) {
    row.emplace_back(name);
  }
  return row;
}

Row cells_of(const ComparedRun& run, const Comparison& comparison) {
  const RunFigures& figures = run.figures;
  const auto makespan = run.makespan();
  Row row = {run.policy,
             std::to_string(run.summary.jobs.at(to_string(JobState::succeeded))) + " of " +
                 std::to_string(comparison.jobs),
             other_ends(run.summary), makespan ? seconds(*makespan, 2) : "-",
             percent(share(run.least, run))};
  for (const Duration busy : figures.busy) row.push_back(percent(share(busy, run)));
  row.push_back(percent(share(figures.together, run)));
  row.push_back(seconds(run.summary.wait_mean, 2));
  row.push_back(seconds(run.summary.wait_max, 2));
  row.push_back(std::isfinite(figures.min_clearance_m) ? fixed(figures.min_clearance_m * 1e3, 1)
                                                       : "-");
  row.push_back(std::to_string(figures.monitor_stops));
  row.push_back(std::to_string(run.judging.judgements));
  row.push_back(
      fixed(to_seconds(run.judging.wall) * 1e3 / static_cast<double>(jobs_run(comparison)), 2));
  row.push_back(seconds(run.wall, 2));
  return row;
}

// Names are aligned left, numbers right.
bool is_text(std::size_t column) { return column == 0 || column == 2; }

std::string padded(const Row& row, const std::vector<std::size_t>& widths) {
  std::string line = "|";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string space(widths[i] - width(row[i]), ' ');
    line += " " + (is_text(i) ? row[i] + space : space + row[i]) + " |";
  }
  return line + "\n";
}

// ---- CSV ----

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string line_of(const Row& row) {
  std::string line;
  for (const std::string& cell : row) line += (line.empty() ? "" : ",") + quoted(cell);
  return line + "\n";
}

Row csv_row(const ComparedRun& run, const Comparison& comparison) {
  const RunFigures& figures = run.figures;
  const auto makespan = run.makespan();
  const auto ratio = [&](Duration part) {
    const auto found = share(part, run);
    return found ? fixed(*found, 6) : std::string();
  };
  Row row = {run.policy, std::to_string(comparison.seed), std::to_string(comparison.jobs)};
  std::size_t told = run.summary.jobs.at("refused");
  for (const JobState state : kJobEnds) {
    row.push_back(std::to_string(run.summary.jobs.at(to_string(state))));
    told += run.summary.jobs.at(to_string(state));
  }
  row.push_back(std::to_string(run.summary.jobs.at("refused")));
  row.push_back(std::to_string(comparison.jobs - told));
  row.push_back(makespan ? seconds(*makespan, 3) : "");
  row.push_back(seconds(run.least, 3));
  for (const Duration busy : figures.busy) row.push_back(ratio(busy));
  row.push_back(ratio(figures.together));
  row.push_back(seconds(run.summary.wait_mean, 6));
  row.push_back(seconds(run.summary.wait_max, 3));
  row.push_back(std::isfinite(figures.min_clearance_m) ? fixed(figures.min_clearance_m, 6) : "");
  row.push_back(std::to_string(figures.monitor_stops));
  row.push_back(std::to_string(run.judging.judgements));
  row.push_back(std::to_string(run.judging.evaluations));
  row.push_back(seconds(run.judging.wall, 6));
  row.push_back(seconds(run.wall, 6));
  return row;
}

// ---- SVG ----

struct Picture {
  static constexpr double kBars_x = 150.0;
  static constexpr double kBars_w = 420.0;
  static constexpr double kTop_y = 62.0;
  static constexpr double kRow_h = 28.0;
  static constexpr double kWidth = 780.0;  // room for text after the bars

  std::string text;

  void word(double x, double y, const char* anchor, const std::string& content) {
    text += "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor +
            "\">" + xml_escaped(content) + "</text>\n";
  }
};

}  // namespace

std::optional<Duration> ComparedRun::makespan() const {
  if (!all_ended || summary.makespan <= Duration{}) return std::nullopt;
  return summary.makespan;
}

std::string comparison_markdown(const Comparison& comparison) {
  std::vector<Row> rows = {heading(comparison)};
  for (const ComparedRun& run : comparison.runs) rows.push_back(cells_of(run, comparison));
  std::vector<std::size_t> widths(rows.front().size(), 4);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string table;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    table += padded(rows[r], widths);
    if (r > 0) continue;
    table += "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
      table += " " + std::string(widths[i] - 1, '-') + (is_text(i) ? "- |" : ": |");
    }
    table += "\n";
  }
  return table;
}

std::string comparison_csv(const Comparison& comparison) {
  Row names = {"policy", "seed", "jobs"};
  for (const JobState state : kJobEnds) names.emplace_back(to_string(state));
  for (const char* name : {"refused", "unfinished", "makespan_s", "busiest_arm_work_s"}) {
    names.emplace_back(name);
  }
  for (const std::string& arm : comparison.arms) names.push_back("busy_ratio_" + arm);
  for (const char* name : {"together_ratio", "wait_mean_s", "wait_max_s", "min_clearance_m",
                           "monitor_stops", "judgements", "evaluations", "judging_s", "wall_s"}) {
    names.emplace_back(name);
  }
  std::string text = line_of(names);
  for (const ComparedRun& run : comparison.runs) text += line_of(csv_row(run, comparison));
  return text;
}

std::string comparison_svg(const Comparison& comparison) {
  double longest_s = std::max(to_seconds(comparison.busiest_work), 1e-3);
  for (const ComparedRun& run : comparison.runs) {
    longest_s = std::max(longest_s, to_seconds(run.makespan().value_or(Duration{})));
  }
  const double bottom_y =
      Picture::kTop_y + Picture::kRow_h * static_cast<double>(comparison.runs.size());
  const std::string size =
      "width=\"" + fixed(Picture::kWidth, 0) + "\" height=\"" + fixed(bottom_y + 16, 0) + "\"";
  Picture picture;
  picture.text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/"
      "svg\" " +
      size + " font-family=\"sans-serif\" font-size=\"13\">\n<rect " + size +
      " fill=\"#ffffff\"/>\n";
  picture.word(16, 24, "start",
               comparison.cell + ": makespan of " + std::to_string(comparison.jobs) +
                   " jobs, s (seed " + std::to_string(comparison.seed) + ")");
  double y = Picture::kTop_y;
  for (const ComparedRun& run : comparison.runs) {
    const auto makespan = run.makespan();
    const double w = makespan ? Picture::kBars_w * to_seconds(*makespan) / longest_s : 0.0;
    picture.word(Picture::kBars_x - 8, y + 15, "end", run.policy);
    picture.text += "<rect x=\"" + fixed(Picture::kBars_x, 1) + "\" y=\"" + fixed(y, 1) +
                    "\" width=\"" + fixed(w, 1) + "\" height=\"20\" fill=\"#4878a8\"/>\n";
    const std::string ends = other_ends(run.summary);
    picture.word(Picture::kBars_x + w + 6, y + 15, "start",
                 (makespan ? seconds(*makespan, 2) : "did not end") +
                     (ends == "-" ? "" : " (" + ends + ")"));
    y += Picture::kRow_h;
  }
  if (!comparison.busiest.empty()) {
    const std::string x = fixed(
        Picture::kBars_x + Picture::kBars_w * to_seconds(comparison.busiest_work) / longest_s, 1);
    picture.text += "<line x1=\"" + x + "\" y1=\"" + fixed(Picture::kTop_y - 6, 1) + "\" x2=\"" +
                    x + "\" y2=\"" + fixed(bottom_y, 1) +
                    "\" stroke=\"#b04030\" stroke-dasharray=\"4 3\"/>\n";
    picture.word(Picture::kBars_x, 46, "start",
                 "dashed: " + comparison.busiest + "'s own work, " +
                     seconds(comparison.busiest_work, 2) + " s");
  }
  return picture.text + "</svg>\n";
}

}  // namespace armloom
