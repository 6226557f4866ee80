#include "server/command/reach_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "server/command/xml_escaped.h"

namespace armloom {
namespace {

constexpr const char* kColours[] = {"#1f77b4", "#d95f02", "#1b9e77", "#7570b3",
                                    "#e7298a", "#66a61e", "#a6761d", "#666666"};
constexpr double kScale = 240.0;  // pixels per meter
constexpr double kMargin = 56.0;  // pixels
constexpr double kGap = 64.0;
constexpr double kHead = 64.0;

const char* colour_of(std::size_t arm) { return kColours[arm % std::size(kColours)]; }

std::string formatted(const char* format, double a, double b = 0.0, double c = 0.0,
                      double d = 0.0) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b, c, d);
  return text;
}

// A view along one axis of the world. The x axis points to the right, the axis `up` (1: y, 2: z)
// upward. A column is the row of positions behind one square of the view.
class View {
 public:
  View(const ToolReach& reach, std::size_t up, double left)
      : reach_(reach), grid_(reach.grid), up_(up), along_(up == 1 ? 2 : 1), left_(left) {}

  [[nodiscard]] double width() const { return kScale * grid_.step_m * grid_.count[0]; }
  [[nodiscard]] double height() const { return kScale * grid_.step_m * grid_.count[up_]; }

  void draw(std::string& svg) const {
    const char* title = up_ == 1 ? "seen from above" : "seen from the side";
    svg += formatted("<text x=\"%.1f\" y=\"%.1f\" font-weight=\"bold\">", left_, kHead - 12) +
           title + "</text>\n";
    svg += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" ", left_, kHead,
                     width(), height()) +
           "fill=\"none\" stroke=\"#999\"/>\n";
    for (std::size_t arm = 0; arm < reach_.arms.size(); ++arm) draw_arm(svg, arm);
    draw_shared(svg);
    draw_axis(svg);
    for (std::size_t arm = 0; arm < reach_.arms.size(); ++arm) draw_base(svg, arm);
  }

 private:
  [[nodiscard]] std::size_t columns() const {
    return static_cast<std::size_t>(grid_.count[0]) * static_cast<std::size_t>(grid_.count[up_]);
  }
  // Returns the number of positions in the column that the arm reaches.
  [[nodiscard]] int reached(std::size_t arm, std::size_t column) const {
    const auto nx = static_cast<std::size_t>(grid_.count[0]);
    const auto ny = static_cast<std::size_t>(grid_.count[1]);
    const std::size_t x = column % nx, v = column / nx;
    int sum = 0;
    for (std::size_t w = 0; w < static_cast<std::size_t>(grid_.count[along_]); ++w) {
      const std::size_t y = up_ == 1 ? v : w, z = up_ == 1 ? w : v;
      sum += reach_.arms[arm].directions[x + nx * (y + ny * z)] > 0 ? 1 : 0;
    }
    return sum;
  }
  [[nodiscard]] double pixel_x(double x_m) const {
    return left_ + kScale * (x_m - grid_.first[0] + 0.5 * grid_.step_m);
  }
  [[nodiscard]] double pixel_up(double up_m) const {
    const double first = grid_.first[static_cast<Eigen::Index>(up_)];
    return kHead + height() - kScale * (up_m - first + 0.5 * grid_.step_m);
  }
  [[nodiscard]] std::string square(std::size_t column, double inset) const {
    const double size = kScale * grid_.step_m;
    const auto nx = static_cast<std::size_t>(grid_.count[0]);
    const double x = left_ + size * static_cast<double>(column % nx);
    const double y = kHead + height() - size * static_cast<double>(column / nx + 1);
    return formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" ", x + inset,
                     y + inset, size - 2 * inset, size - 2 * inset);
  }

  void draw_arm(std::string& svg, std::size_t arm) const {
    std::vector<int> counts;
    for (std::size_t c = 0; c < columns(); ++c) counts.push_back(reached(arm, c));
    const int most = std::max(1, *std::ranges::max_element(counts));
    svg += std::string("<g fill=\"") + colour_of(arm) + "\">\n";
    for (std::size_t c = 0; c < columns(); ++c) {
      if (counts[c] == 0) continue;
      const double share = static_cast<double>(counts[c]) / most;
      svg += square(c, 0.0) + formatted("fill-opacity=\"%.2f\"/>\n", 0.15 + 0.4 * share);
    }
    svg += "</g>\n";
  }
  // Returns true if at least two arms reach the same position in the column.
  [[nodiscard]] bool is_shared(std::size_t column) const {
    const auto nx = static_cast<std::size_t>(grid_.count[0]);
    const auto ny = static_cast<std::size_t>(grid_.count[1]);
    const std::size_t x = column % nx, v = column / nx;
    for (std::size_t w = 0; w < static_cast<std::size_t>(grid_.count[along_]); ++w) {
      const std::size_t place = x + nx * (up_ == 1 ? v + ny * w : w + ny * v);
      const auto reaches = [&](const ArmReach& arm) { return arm.directions[place] > 0; };
      if (std::ranges::count_if(reach_.arms, reaches) > 1) return true;
    }
    return false;
  }
  void draw_shared(std::string& svg) const {
    svg += "<g fill=\"none\" stroke=\"#222\" stroke-width=\"1\">\n";
    for (std::size_t c = 0; c < columns(); ++c) {
      if (is_shared(c)) svg += square(c, 1.5) + "/>\n";
    }
    svg += "</g>\n";
  }
  void draw_base(std::string& svg, std::size_t arm) const {
    const Eigen::Vector3d& base = reach_.arms[arm].base;
    svg += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"6\" ", pixel_x(base.x()),
                     pixel_up(base[static_cast<Eigen::Index>(up_)])) +
           "fill=\"" + colour_of(arm) + "\" stroke=\"#fff\" stroke-width=\"2\"/>\n";
  }
  // Labels every half meter.
  void draw_axis(std::string& svg) const {
    svg += "<g fill=\"#555\">\n";
    const auto last = [&](std::size_t axis) {
      return grid_.first[static_cast<Eigen::Index>(axis)] + grid_.step_m * (grid_.count[axis] - 1);
    };
    for (double x = std::ceil(2 * grid_.first[0]) / 2; x <= last(0) + 1e-9; x += 0.5) {
      svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%.1f</text>\n",
                       pixel_x(x), kHead + height() + 16, x + 0.0);
    }
    const double lowest = grid_.first[static_cast<Eigen::Index>(up_)];
    for (double u = std::ceil(2 * lowest) / 2; u <= last(up_) + 1e-9; u += 0.5) {
      svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.1f</text>\n", left_ - 6,
                       pixel_up(u) + 4, u + 0.0);
    }
    svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">x, m</text>\n",
                     left_ + width(), kHead + height() + 32);
    svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">", left_ - 6, kHead - 4) +
           (up_ == 1 ? "y, m" : "z, m") + "</text>\n</g>\n";
  }

  const ToolReach& reach_;
  const ReachGrid& grid_;
  std::size_t up_;
  std::size_t along_;  // axis along which the view looks (1: y, 2: z)
  double left_;
};

}  // namespace

std::string reach_picture(const ToolReach& reach, const Cell& cell) {
  const View above(reach, 1, kMargin);
  const View side(reach, 2, kMargin + above.width() + kGap);
  const double width = std::max(kMargin + above.width() + kGap + side.width() + 16, 480.0);
  const double height = kHead + std::max(above.height(), side.height()) + 44;
  std::string svg = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" "
      "height=\"%.0f\" font-family=\"sans-serif\" font-size=\"12\">\n",
      width, height);
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  double x = kMargin;
  for (std::size_t arm = 0; arm < reach.arms.size(); ++arm) {
    const std::string& name = cell.arm(reach.arms[arm].arm).name;
    svg += formatted("<circle cx=\"%.1f\" cy=\"20\" r=\"6\" fill=\"", x + 6) + colour_of(arm) +
           "\"/>\n" + formatted("<text x=\"%.1f\" y=\"24\">", x + 18) + xml_escaped(name) +
           "</text>\n";
    x += 34 + 8.0 * static_cast<double>(name.size());
  }
  svg += formatted(
      "<rect x=\"%.1f\" y=\"14\" width=\"12\" height=\"12\" fill=\"none\" stroke=\"#222\"/>\n<text "
      "x=\"%.1f\" y=\"24\">reached by several arms</text>\n",
      x, x + 18);
  above.draw(svg);
  side.draw(svg);
  return svg + "</svg>\n";
}

}  // namespace armloom
