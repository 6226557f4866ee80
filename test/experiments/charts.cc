#include "test/experiments/charts.h"

#include <algorithm>

#include "test/experiments/tables.h"

namespace armloom::experiments {
namespace {

constexpr double kWidth = 820.0;
constexpr double kLeft = 130.0;   // names are to the left
constexpr double kRight = 720.0;  // values are to the right

class Picture {
 public:
  void word(double x, double y, const char* anchor, const std::string& text, int size = 13) {
    body_ += "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor +
             "\" font-size=\"" + std::to_string(size) + "\">" + text + "</text>\n";
  }
  struct Box {
    double x, y, width, height;
  };
  void box(const Box& at, const std::string& fill, double opacity = 1.0) {
    body_ += "<rect x=\"" + fixed(at.x, 1) + "\" y=\"" + fixed(at.y, 1) + "\" width=\"" +
             fixed(at.width, 1) + "\" height=\"" + fixed(at.height, 1) + "\" fill=\"" + fill +
             "\" fill-opacity=\"" + fixed(opacity, 2) + "\"/>\n";
  }
  void dot(double x, double y) {
    body_ += "<circle cx=\"" + fixed(x, 1) + "\" cy=\"" + fixed(y, 1) +
             "\" r=\"2.2\" fill=\"#1c2a38\" fill-opacity=\"0.65\"/>\n";
  }
  void upright(double x, double y0, double y1, const char* style) {
    body_ += "<line x1=\"" + fixed(x, 1) + "\" y1=\"" + fixed(y0, 1) + "\" x2=\"" + fixed(x, 1) +
             "\" y2=\"" + fixed(y1, 1) + "\" " + style + "/>\n";
  }
  [[nodiscard]] std::string svg(double height) const {
    const std::string size =
        "width=\"" + fixed(kWidth, 0) + "\" height=\"" + fixed(height, 0) + "\"";
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "
           "xmlns=\"http://www.w3.org/2000/svg\" " +
           size + " font-family=\"sans-serif\">\n<rect " + size + " fill=\"#ffffff\"/>\n" + body_ +
           "</svg>\n";
  }

 private:
  std::string body_;
};

// Maps seconds to x, and draws the scale below the picture.
class Scale {
 public:
  explicit Scale(double longest_s) : longest_s_(std::max(longest_s, 1e-3)) {}
  [[nodiscard]] double x(double time_s) const {
    return kLeft + (kRight - kLeft) * time_s / longest_s_;
  }
  void draw(Picture& picture, double y) const {
    const double step_s = longest_s_ > 60.0 ? 20.0 : longest_s_ > 25.0 ? 10.0 : 5.0;
    for (double time_s = 0.0; time_s <= longest_s_; time_s += step_s) {
      picture.upright(x(time_s), y - 6.0, y, "stroke=\"#888888\"");
      picture.word(x(time_s), y + 12.0, "middle", fixed(time_s, 0) + " s", 11);
    }
  }

 private:
  double longest_s_;
};

}  // namespace

std::string makespan_svg(const WorkloadKind& kind, const std::vector<RunRow>& rows) {
  constexpr double kRow = 30.0;
  const std::vector<std::string> policies = policies_of(rows, kind.name);
  double longest_s = 0.0;
  for (const RunRow& row : rows) {
    if (row.workload == kind.name) longest_s = std::max(longest_s, row.makespan_s);
  }
  const Scale scale(longest_s);
  Picture picture;
  picture.word(16, 24, "start", kind.title + ": makespan, mean (bar) and every seed (dots)", 14);
  double y = 58.0;
  for (const std::string& policy : policies) {
    const auto of_policy = rows_of(rows, kind.name, policy);
    const double mean_s = spread_of(of_policy, &RunRow::makespan_s).mean;
    picture.word(kLeft - 8, y + 15, "end", policy);
    picture.box({kLeft, y, scale.x(mean_s) - kLeft, 21}, "#4878a8", 0.75);
    for (std::size_t i = 0; i < of_policy.size(); ++i) {
      const double part = static_cast<double>(i + 1) / static_cast<double>(of_policy.size() + 1);
      picture.dot(scale.x(of_policy[i]->makespan_s), y + 21.0 * part);
    }
    picture.word(kRight + 14, y + 15, "start", fixed(mean_s, 2) + " s");
    y += kRow;
  }
  if (!kind.of_tasks) {
    const double bound_s = mean_bound_s(rows_of(rows, kind.name, policies.back()));
    picture.upright(scale.x(bound_s), 50, y, "stroke=\"#b04030\" stroke-dasharray=\"4 3\"");
    picture.word(kLeft, 44, "start", "dashed: lower bound, " + fixed(bound_s, 2) + " s", 12);
  }
  scale.draw(picture, y + 6.0);
  return picture.svg(y + 30.0);
}

}  // namespace armloom::experiments
