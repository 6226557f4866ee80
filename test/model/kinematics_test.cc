#include "core/model/kinematics.h"

#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <kdl/frames.hpp>
#include <kdl/jntarray.hpp>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <map>
#include <random>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

KDL::Frame frame_of(const urdf::Pose& pose) {
  const auto& r = pose.rotation;
  return {KDL::Rotation::Quaternion(r.x, r.y, r.z, r.w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

KDL::Joint joint_of(const urdf::Joint& joint) {
  if (joint.type == urdf::Joint::FIXED) return KDL::Joint(joint.name, KDL::Joint::Fixed);
  const KDL::Frame frame = frame_of(joint.parent_to_joint_origin_transform);
  const KDL::Vector axis = frame.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
  return {joint.name, frame.p, axis,
          joint.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis};
}

void add_children(const urdf::Link& link, KDL::Tree& tree) {
  for (const auto& child : link.child_links) {
    const auto& joint = *child->parent_joint;
    const KDL::Segment segment(child->name, joint_of(joint),
                               frame_of(joint.parent_to_joint_origin_transform));
    ASSERT_TRUE(tree.addSegment(segment, link.name)) << child->name;
    add_children(*child, tree);
  }
}

// The same robot in Orocos KDL, built directly from the URDF.
struct KdlRobot {
  explicit KdlRobot(const RobotDescription& description)
      : model(urdf::parseURDFFile(description.urdf)),
        tree(model->getRoot()->name),
        prefix(description.prefix) {
    X_WB = KDL::Frame(
        KDL::Rotation(description.X_WB(0, 0), description.X_WB(0, 1), description.X_WB(0, 2),
                      description.X_WB(1, 0), description.X_WB(1, 1), description.X_WB(1, 2),
                      description.X_WB(2, 0), description.X_WB(2, 1), description.X_WB(2, 2)),
        KDL::Vector(description.X_WB(0, 3), description.X_WB(1, 3), description.X_WB(2, 3)));
    add_children(*model->getRoot(), tree);
  }

  KDL::JntArray positions(const std::map<std::string, double>& q) const {
    KDL::JntArray out(tree.getNrOfJoints());
    for (const auto& [name, joint] : model->joints_) {
      if (joint->type == urdf::Joint::FIXED) continue;
      const double value =
          joint->mimic == nullptr
              ? q.at(prefix + name)
              : joint->mimic->multiplier * q.at(prefix + joint->mimic->joint_name) +
                    joint->mimic->offset;
      out(tree.getSegment(joint->child_link_name)->second.q_nr) = value;
    }
    return out;
  }

  urdf::ModelInterfaceSharedPtr model;
  KDL::Tree tree;
  std::string prefix;
  KDL::Frame X_WB;
};

double largest_difference(const KDL::Frame& expected, const Eigen::Isometry3d& X) {
  double worst = 0.0;
  for (int row = 0; row < 3; ++row) {
    worst = std::max(worst, std::abs(expected.p(row) - X.translation()[row]));
    for (int column = 0; column < 3; ++column) {
      worst = std::max(worst, std::abs(expected.M(row, column) - X.linear()(row, column)));
    }
  }
  return worst;
}

// Returns the largest difference of any link pose over random configurations.
double compare_with_kdl(const CellDescription& description, std::uint32_t seed, int rounds) {
  const CellPtr cell = build_or_fail(description);
  std::mt19937 random(seed);
  LinkPoses X_WL;
  double worst = 0.0;
  std::vector<KdlRobot> robots(description.robots.begin(), description.robots.end());
  for (int round = 0; round < rounds; ++round) {
    Configuration q(static_cast<Eigen::Index>(cell->joints.size()));
    std::map<std::string, double> by_name;
    for (std::size_t j = 0; j < cell->joints.size(); ++j) {
      const Joint& joint = cell->joints[j];
      std::uniform_real_distribution<double> within(std::max(joint.lower, -7.0),
                                                    std::min(joint.upper, 7.0));
      by_name[joint.name] = q[static_cast<Eigen::Index>(j)] = within(random);
    }
    forward_kinematics(*cell, q, X_WL);
    std::size_t compared = 0;
    for (const auto& robot : robots) {
      const KDL::JntArray q_kdl = robot.positions(by_name);
      KDL::TreeFkSolverPos_recursive solver(robot.tree);
      for (const auto& [name, link] : robot.model->links_) {
        KDL::Frame X_BL = KDL::Frame::Identity();
        EXPECT_GE(solver.JntToCart(q_kdl, X_BL, name), 0) << name;
        worst = std::max(worst,
                         largest_difference(robot.X_WB * X_BL,
                                            X_WL[cell->find_link(robot.prefix + name)->index()]));
        ++compared;
      }
    }
    EXPECT_EQ(compared, cell->links.size());
  }
  return worst;
}

TEST(ForwardKinematics, AgreesWithKdlOnPrismaticMimicAndFixedJoints) {
  EXPECT_LT(compare_with_kdl(two_arms_description(), 1, 1000), 1e-9);
}

TEST(ForwardKinematics, AgreesWithKdlOnTwoPandasWithTheirBases) {
  EXPECT_LT(compare_with_kdl(two_pandas_description(), 2, 1000), 1e-9);
}

TEST(ForwardKinematics, ThrowsOnAConfigurationOfWrongSize) {
  const CellPtr cell = build_or_fail(two_arms_description());
  LinkPoses X_WL;
  EXPECT_THROW(forward_kinematics(*cell, Configuration::Zero(3), X_WL), std::invalid_argument);
}

TEST(ForwardKinematics, ReusesTheCallersMemory) {
  const CellPtr cell = build_or_fail(two_arms_description());
  LinkPoses X_WL;
  forward_kinematics(*cell, cell->home(), X_WL);
  const auto* memory = X_WL.data();
  forward_kinematics(*cell, cell->home(), X_WL);
  EXPECT_EQ(X_WL.data(), memory);
  EXPECT_EQ(X_WL.size(), cell->links.size());
}

}  // namespace
}  // namespace armloom
