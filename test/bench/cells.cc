#include "test/bench/cells.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "test/source_dir.h"

namespace armloom::bench {
namespace {

constexpr double kTableTop_m = 0.1;

template <class T>
T value_of(Result<T> result) {
  if (result) return std::move(*result);
  std::string all;
  for (const Problem& problem : result.error()) {
    all += problem.pointer + ": " + problem.detail + "\n";
  }
  throw std::runtime_error(all);
}

CellDescription two_pandas_description() {
  const std::string folder = source_dir() + "/config";
  std::ifstream file(folder + "/two_pandas.json");
  std::ostringstream text;
  text << file.rdbuf();
  return value_of(read_cell_text(text.str(), folder));
}

RobotDescription panda(const RobotDescription& like, std::size_t index,
                       const Eigen::Isometry3d& X_WB) {
  RobotDescription robot = like;
  robot.name = "panda" + std::to_string(index);
  robot.prefix = robot.name + "_";
  robot.arms[0].name = robot.name;
  robot.X_WB = X_WB;
  return robot;
}

CellDescription empty_cell(const std::string& name, const CellDescription& like) {
  CellDescription cell = like;
  cell.name = name;
  cell.robots.clear();
  cell.objects.clear();
  cell.allowed_collisions.clear();
  return cell;
}

void put_table(const Eigen::Vector2d& size_m, const Eigen::Vector2d& p_WO, CellDescription& cell) {
  cell.objects.push_back(
      {"table", Box{{size_m.x(), size_m.y(), kTableTop_m}},
       Eigen::Isometry3d(Eigen::Translation3d(p_WO.x(), p_WO.y(), kTableTop_m / 2.0))});
  for (const RobotDescription& robot : cell.robots) {
    cell.allowed_collisions.emplace_back("table", robot.prefix + "panda_link0");
  }
}

Eigen::Isometry3d standing_at(double x_m, double y_m, double yaw) {
  return Eigen::Translation3d(x_m, y_m, kTableTop_m) *
         Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

}  // namespace

CellPtr two_pandas() { return value_of(build_cell(two_pandas_description())); }

CellPtr panda_among_objects(bool contact) {
  const CellDescription like = two_pandas_description();
  CellDescription cell = empty_cell("objects", like);
  cell.robots.push_back(panda(like.robots[0], 0, Eigen::Isometry3d::Identity()));
  const Eigen::Vector3d shoulder(0.0, 0.0, 0.333);
  std::mt19937_64 random(53);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (int i = 0; i < 20; ++i) {
    Eigen::Vector3d direction(between(-1.0, 1.0), between(-1.0, 1.0), between(-0.3, 1.0));
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.translation() = shoulder + between(0.4, 0.9) * direction.normalized();
    X_WO.linear() =
        Eigen::AngleAxisd(between(0.0, std::numbers::pi), Eigen::Vector3d::UnitZ()).matrix();
    const double size_m = between(0.1, 0.2);
    const Shape shape = i % 2 == 0 ? Shape(Box{{size_m, between(0.1, 0.2), between(0.1, 0.2)}})
                                   : Shape(Sphere{0.5 * size_m});
    cell.objects.push_back({"object" + std::to_string(i), shape, X_WO});
  }
  if (contact) {
    cell.clearance_m = 0.0;
    cell.self_clearance_m = 0.0;
    cell.monitor.stop_clearance_m = 0.0;
    cell.checking.tracking_error_rad = 0.0;
  }
  return value_of(build_cell(cell));
}

CellPtr circle_of_pandas(std::size_t count, double radius_m) {
  const CellDescription like = two_pandas_description();
  CellDescription cell = empty_cell("circle", like);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    cell.robots.push_back(panda(like.robots[0], i,
                                standing_at(radius_m * std::cos(angle), radius_m * std::sin(angle),
                                            angle - std::numbers::pi)));
  }
  const double side_m = 2.0 * (radius_m + 0.5);
  put_table({side_m, side_m}, {0.0, 0.0}, cell);
  return value_of(build_cell(cell));
}

CellPtr line_of_pandas(std::size_t count, double spacing_m) {
  const CellDescription like = two_pandas_description();
  CellDescription cell = empty_cell("hall", like);
  for (std::size_t i = 0; i < count; ++i) {
    cell.robots.push_back(
        panda(like.robots[0], i,
              standing_at(spacing_m * static_cast<double>(i), 0.0, std::numbers::pi / 2.0)));
  }
  const double length_m = spacing_m * static_cast<double>(count - 1);
  put_table({length_m + 2.0, 2.0}, {length_m / 2.0, 0.0}, cell);
  return value_of(build_cell(cell));
}

CellPtr grid_of_pandas(std::size_t columns, std::size_t rows, double spacing_m) {
  const CellDescription like = two_pandas_description();
  CellDescription cell = empty_cell("wide hall", like);
  for (std::size_t i = 0; i < columns * rows; ++i) {
    const auto column = static_cast<double>(i % columns), row = static_cast<double>(i / columns);
    cell.robots.push_back(
        panda(like.robots[0], i,
              standing_at(spacing_m * column, spacing_m * row, std::numbers::pi / 2.0)));
  }
  const double length_m = spacing_m * static_cast<double>(columns - 1);
  const double depth_m = spacing_m * static_cast<double>(rows - 1);
  put_table({length_m + 2.0, depth_m + 2.0}, {length_m / 2.0, depth_m / 2.0}, cell);
  return value_of(build_cell(cell));
}

}  // namespace armloom::bench
