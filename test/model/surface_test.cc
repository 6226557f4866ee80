// The shapes of every model in models/ must contain the robot. The published outermost points of
// each link lie inside by the reserve that the URDF states ("reserve: 3 mm"). Independent of the
// product: urdfdom and closed forms.
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

#include "test/source_dir.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(source_dir()) / "models";

using Surface =
    std::map<std::string, std::vector<Eigen::Vector3d>>;  // by link, in the link's frame

struct Table {
  std::string file;    // in models/
  std::string prefix;  // of the links in the model
};
struct Model {
  std::string name;
  std::vector<Table> tables;
};
void PrintTo(const Model& model, std::ostream* out) { *out << model.name; }

const std::vector<Model> kKnown = {
    {"panda", {{"panda_surface.csv", ""}}},
    {"dual_panda",
     {{"dual_panda_surface.csv", ""},
      {"panda_surface.csv", "left_"},
      {"panda_surface.csv", "right_"}}},
    {"ur5e", {{"ur5e_surface.csv", ""}}},
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void read_table(const Table& table, Surface& surface) {
  std::istringstream in(text_of(kModels / table.file));
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#') || line == "link,x_m,y_m,z_m") continue;
    std::ranges::replace(line, ',', ' ');
    std::istringstream fields(line);
    std::string link;
    Eigen::Vector3d p;
    fields >> link >> p.x() >> p.y() >> p.z();
    ASSERT_FALSE(fields.fail()) << table.file << ": " << line;
    surface[table.prefix + link].push_back(p);
  }
}

Surface surface_of(const Model& model) {
  Surface surface;
  for (const Table& table : model.tables) read_table(table, surface);
  return surface;
}

double reserve_m(const std::string& urdf) {
  std::smatch found;
  if (!std::regex_search(urdf, found, std::regex(R"(\breserve: (\d+(\.\d+)?) mm)"))) return NAN;
  return std::stod(found[1]) * 1e-3;
}

// Returns how deep the point lies in the shape, after shrinking the shape by `thinner` on each
// side. If the result is negative, the point is outside by at least that distance.
double depth(const urdf::Collision& collision, const Eigen::Vector3d& p_L, double thinner) {
  const auto& at = collision.origin;
  const Eigen::Quaterniond R(at.rotation.w, at.rotation.x, at.rotation.y, at.rotation.z);
  const Eigen::Vector3d p =
      R.conjugate() * (p_L - Eigen::Vector3d(at.position.x, at.position.y, at.position.z));
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(collision.geometry.get())) {
    return sphere->radius - thinner - p.norm();
  }
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(collision.geometry.get())) {
    return std::min(cylinder->radius - std::hypot(p.x(), p.y()),
                    0.5 * cylinder->length - std::abs(p.z())) -
           thinner;
  }
  const auto* box = dynamic_cast<const urdf::Box*>(collision.geometry.get());
  if (box == nullptr) return -std::numeric_limits<double>::infinity();  // no model has meshes
  const Eigen::Vector3d half(0.5 * box->dim.x, 0.5 * box->dim.y, 0.5 * box->dim.z);
  return (half - p.cwiseAbs()).minCoeff() - thinner;
}

// Returns the smallest depth of the points. A point's depth is that in the shape in which it is
// deepest.
double least_depth(const urdf::Link& link, const std::vector<Eigen::Vector3d>& points,
                   double thinner = 0.0) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) {
    double deepest = -std::numeric_limits<double>::infinity();
    for (const auto& collision : link.collision_array) {
      deepest = std::max(deepest, depth(*collision, p, thinner));
    }
    least = std::min(least, deepest);
  }
  return least;
}

class ModelSurface : public ::testing::TestWithParam<Model> {
 protected:
  void SetUp() override {
    const std::string text = text_of(kModels / (GetParam().name + ".urdf"));
    robot_ = urdf::parseURDF(text);
    ASSERT_TRUE(robot_);
    reserve_m_ = reserve_m(text);
    ASSERT_TRUE(std::isfinite(reserve_m_)) << "the file states no reserve";
    surface_ = surface_of(GetParam());
  }
  urdf::ModelInterfaceSharedPtr robot_;
  double reserve_m_ = NAN;
  Surface surface_;
};
INSTANTIATE_TEST_SUITE_P(Models, ModelSurface, ::testing::ValuesIn(kKnown),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(ModelSurface, LiesInsideTheShapesByTheReserve) {
  for (const auto& [name, points] : surface_) {
    const auto link = robot_->getLink(name);
    ASSERT_TRUE(link) << name;
    EXPECT_GE(least_depth(*link, points), reserve_m_) << name;
  }
}

TEST_P(ModelSurface, CoversEveryLinkThatHasShapes) {
  for (const auto& [name, link] : robot_->links_) {
    if (link->collision_array.empty()) continue;
    const auto found = surface_.find(name);
    EXPECT_GE(found == surface_.end() ? 0 : found->second.size(), 8U) << name;
  }
}

TEST_P(ModelSurface, DetectsShapesThatAreTooThin) {
  constexpr double kSharp_m = 0.006;
  for (const auto& [name, points] : surface_) {
    EXPECT_LT(least_depth(*robot_->getLink(name), points, kSharp_m), reserve_m_) << name;
  }
}

TEST(ModelSurfaces, CoverEveryModel) {
  for (const auto& entry : fs::directory_iterator(kModels)) {
    if (entry.path().extension() != ".urdf") continue;
    const auto known = std::ranges::find(kKnown, entry.path().stem().string(), &Model::name);
    EXPECT_NE(known, kKnown.end()) << entry.path();
  }
}

}  // namespace
}  // namespace armloom
