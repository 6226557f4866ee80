#include <gmock/gmock.h>
#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <fstream>
#include <sstream>

#include "core/model/urdf/urdf_model.h"
#include "core/model/urdf/urdf_reader.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  const auto& [x, y, z, w] = pose.rotation;
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(w, x, y, z);
}

void expect_same_limits(const urdf::Joint& joint, const UrdfLimits& limits) {
  const bool endless = joint.type == urdf::Joint::CONTINUOUS;
  ASSERT_NE(joint.limits, nullptr) << joint.name;
  EXPECT_EQ(limits.velocity, joint.limits->velocity) << joint.name;
  EXPECT_EQ(limits.lower.has_value(), !endless) << joint.name;
  EXPECT_EQ(limits.upper.has_value(), !endless) << joint.name;
  if (endless) return;
  EXPECT_EQ(limits.lower, joint.limits->lower) << joint.name;
  EXPECT_EQ(limits.upper, joint.limits->upper) << joint.name;
}

void expect_same_joint(const urdf::Joint& joint, const RobotTree& tree) {
  ASSERT_TRUE(tree.by_joint.contains(joint.name)) << joint.name;
  const TreeLink& link = tree.links[tree.by_joint.at(joint.name)];
  EXPECT_EQ(link.name, joint.child_link_name);
  EXPECT_EQ(tree.links.at(link.parent.value()).name, joint.parent_link_name);
  EXPECT_TRUE(link.joint.X_PJ.isApprox(pose_of(joint.parent_to_joint_origin_transform), 1e-15))
      << joint.name;
  ASSERT_EQ(link.joint.motion.has_value(), joint.type != urdf::Joint::FIXED) << joint.name;
  if (!link.joint.motion) return;
  EXPECT_EQ(*link.joint.motion == JointKind::prismatic, joint.type == urdf::Joint::PRISMATIC);
  EXPECT_EQ(*link.joint.motion == JointKind::continuous, joint.type == urdf::Joint::CONTINUOUS);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  EXPECT_TRUE(link.joint.axis.isApprox(axis.normalized(), 1e-15)) << joint.name;
  expect_same_limits(joint, link.joint.limits);
  ASSERT_EQ(link.joint.mimic.has_value(), joint.mimic != nullptr) << joint.name;
  if (!link.joint.mimic) return;
  EXPECT_EQ(tree.links[link.joint.mimic->driver].joint.name, joint.mimic->joint_name);
  EXPECT_EQ(link.joint.mimic->multiplier, joint.mimic->multiplier);
  EXPECT_EQ(link.joint.mimic->offset, joint.mimic->offset);
}

std::vector<double> numbers_of(const urdf::Geometry& geometry) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry))
    return {box->dim.x, box->dim.y, box->dim.z};
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) return {sphere->radius};
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry))
    return {cylinder->radius, cylinder->length};
  const auto& scale = dynamic_cast<const urdf::Mesh&>(geometry).scale;
  return {scale.x, scale.y, scale.z};
}

std::vector<double> numbers_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape))
    return {box->size_m.x(), box->size_m.y(), box->size_m.z()};
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {sphere->radius_m};
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return {cylinder->radius_m, cylinder->length_m};
  const auto& scale = std::get<Mesh>(shape).scale;
  return {scale.x(), scale.y(), scale.z()};
}

int expect_same_shapes(const urdf::Link& link, const std::vector<PlacedShape>& shapes) {
  EXPECT_EQ(shapes.size(), link.collision_array.size()) << link.name;
  for (std::size_t i = 0; i < std::min(shapes.size(), link.collision_array.size()); ++i) {
    const urdf::Collision& collision = *link.collision_array[i];
    EXPECT_EQ(numbers_of(shapes[i].shape), numbers_of(*collision.geometry)) << link.name;
    EXPECT_TRUE(shapes[i].X_LS.isApprox(pose_of(collision.origin), 1e-15)) << link.name;
    if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(collision.geometry.get())) {
      EXPECT_EQ(std::filesystem::path(std::get<Mesh>(shapes[i].shape).path).filename(),
                std::filesystem::path(mesh->filename).filename());
    }
  }
  return static_cast<int>(shapes.size());
}

RobotTree tree_of(const std::string& text, const std::string& path) {
  Diagnostics diagnostics;
  const std::map<std::string, std::string> packages{{"shapes", data_file("shapes")}};
  auto tree = read_urdf(text, path, packages, diagnostics);
  for (const Problem& problem : diagnostics.take()) ADD_FAILURE() << problem.detail;
  return tree.value();
}

// Gives urdfdom the original file, not the file repaired by read_urdf.
void expect_what_urdfdom_reads(const std::string& path, int links, int shapes) {
  const auto model = urdf::parseURDFFile(path);
  ASSERT_NE(model, nullptr) << path;
  const RobotTree tree = tree_of(text_of_file(path), path);
  EXPECT_EQ(tree.name, model->getName());
  EXPECT_EQ(tree.links.front().name, model->getRoot()->name);
  EXPECT_FALSE(tree.patched);
  ASSERT_EQ(tree.links.size(), static_cast<std::size_t>(links));
  ASSERT_EQ(model->links_.size(), tree.links.size());
  for (const auto& [name, joint] : model->joints_) expect_same_joint(*joint, tree);
  int compared = 0;
  for (const auto& [name, link] : model->links_) {
    ASSERT_TRUE(tree.by_link.contains(name)) << name;
    compared += expect_same_shapes(*link, tree.links[tree.by_link.at(name)].shapes);
  }
  EXPECT_EQ(compared, shapes);
}

TEST(Urdfdom, AgreesOnEveryModel) {
  expect_what_urdfdom_reads(model_file("panda.urdf"), 13, 78);
  expect_what_urdfdom_reads(model_file("dual_panda.urdf"), 27, 157);
  expect_what_urdfdom_reads(model_file("ur5e.urdf"), 8, 41);
  expect_what_urdfdom_reads(data_file("two_arms.urdf"), 11, 5);
}

// Input that urdfdom alone would reject, drop or read differently.
TEST(Urdfdom, GetsARepairedFile) {
  const RobotTree tree = tree_of(
      "<robot name='r' version='7.1'><material/><link name='&lt;a&gt; &amp; \"b\"'>"
      "<inertial><mass value='heavy'/></inertial><visual><geometry><blob/></geometry></visual>"
      "<collision><origin xyz='\t1\n+2 3 '/><geometry><box size='1 2\t3'/></geometry></collision>"
      "<collision><geometry><sphere radius=' .5 '/></geometry></collision></link>"
      "<link name='c'/><link name='d'/><link name='e'/>"
      "<joint name='turn' type='revolute'><parent link='&lt;a&gt; &amp; \"b\"'/><child link='c'/>"
      "<limit lower='-1' velocity='fast'/><dynamics/><safety_controller/></joint>"
      "<joint name='spin' type='continuous'><parent link='c'/><child link='d'/>"
      "<axis xyz='0 3e0 4'/><limit lower='x' velocity='2 '/></joint>"
      "<joint name='float' type='floating'><parent link='c'/><child link='e'/></joint></robot>",
      "/r.urdf");
  ASSERT_EQ(tree.links.size(), 4u);
  ASSERT_EQ(tree.links[0].name, "<a> & \"b\"");
  ASSERT_EQ(tree.links[0].shapes.size(), 2u);
  EXPECT_EQ(tree.links[0].shapes[0].X_LS.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(numbers_of(tree.links[0].shapes[0].shape), testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers_of(tree.links[0].shapes[1].shape), testing::ElementsAre(0.5));
  const TreeLink& turned = tree.links[tree.by_joint.at("turn")];
  EXPECT_EQ(turned.joint.limits.lower, -1.0);
  EXPECT_EQ(turned.joint.limits.upper, std::nullopt);
  EXPECT_EQ(turned.joint.limits.velocity, std::nullopt);
  EXPECT_EQ(turned.joint.limits.faults.count(), 1u);
  const TreeLink& spun = tree.links[tree.by_joint.at("spin")];
  EXPECT_EQ(spun.joint.motion, JointKind::continuous);
  EXPECT_EQ(spun.joint.axis, Eigen::Vector3d(0, 0.6, 0.8));
  EXPECT_EQ(spun.joint.limits.lower, std::nullopt);
  EXPECT_EQ(spun.joint.limits.velocity, 2.0);
  const TreeLink& floating = tree.links[tree.by_joint.at("float")];
  EXPECT_TRUE(floating.joint.many_values && floating.is_rigid());
}

TEST(Urdfdom, ErrorsAreReportedWithItsMessage) {
  const auto refused = [](const std::string& body) {
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(("<robot name='r'>" + body + "</robot>").c_str()), 0);
    Diagnostics diagnostics;
    EXPECT_FALSE(read_with_urdfdom(*document.RootElement(), "r.urdf", {}, diagnostics));
    const Problems problems = diagnostics.take();
    return problems.size() == 1 ? problems[0].slug + " | " + problems[0].detail : "not told";
  };
  EXPECT_THAT(refused("<link name='a'/><link name='b'/>"),
              testing::StartsWith("urdf-refused | r.urdf: robot: urdfdom cannot read it: Failed to "
                                  "find root link: Two root links found: [a] and [b]"));
  EXPECT_THAT(
      refused("<link name='a'><collision><geometry><capsule/></geometry></collision></link>"),
      testing::HasSubstr("Unknown geometry type 'capsule'"));
}

// Joint k connects c with itself; joint l has no links.
TEST(UrdfTree, BrokenTreeIsReportedAndKeepsAllNames) {
  Diagnostics diagnostics;
  const auto tree = read_urdf(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='above all'/>"
      "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
      "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"
      "<joint name='k' type='revolute'><parent link='c'/><child link='c'/></joint>"
      "<joint name='l' type='revolute'><parent link='x'/><child link='y'/><mimic "
      "joint='l'/></joint>"
      "</robot>",
      "/r.urdf", {}, diagnostics);
  ASSERT_TRUE(tree.has_value());
  EXPECT_TRUE(tree->patched);
  EXPECT_EQ(tree->by_link.size(), 4u);
  EXPECT_EQ(tree->by_joint.size(), 3u);
  for (const Problem& problem : diagnostics.take()) EXPECT_NE(problem.slug, "urdf-refused");
  const TreeLink& nameless = tree->links[tree->by_joint.at("l")];
  EXPECT_TRUE(nameless.name.empty() && nameless.is_rigid());
  EXPECT_EQ(nameless.parent, std::nullopt);
}

}  // namespace
}  // namespace armloom
