#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/ball.h"
#include "core/geometry/capsule/segment_distance.h"

namespace armloom {

// Capsules that cover a link at all values of its joints, as a tree of parts. Each part covers the
// link for one box of joint values; parts are halved on request. Joints that no arm moves stay at
// home. Not thread-safe.
class SweptLink {
 public:
  // Joint values from center - half to center + half (rad or m).
  struct Interval {
    double center = 0.0;
    double half = 0.0;
  };
  // The link for a box of joint values:
  // - its capsules with all joints at their centers (world)
  // - motion_m: bound of the distance by which any capsule moves from there within the intervals
  // - ball: contains the link for all these values (world)
  struct Part {
    std::vector<Interval> intervals;
    struct Segment {
      CenteredSegment line;
      double radius_m;
    };
    std::vector<Segment> capsules;
    double motion_m = 0.0;
    Ball ball;
    std::size_t widest = 0;  // index of the interval that moves the link most
    std::size_t halves = 0;  // number of the first half, or 0; the second half is next
  };
  static constexpr std::size_t kPartsMax = 4096;
  static constexpr double kFinest_m = 1e-3;  // a part with a smaller motion_m is not halved

  // `beyond`: distance by which joints may exceed their limits (rad or m).
  SweptLink(const PlanningScene::Bodies& bodies, LinkId link, double beyond);

  // Part 0 covers all joint values.
  [[nodiscard]] const Part& part(std::size_t number) const { return parts_[number]; }
  // Returns the number of the first half, or nullopt if the part cannot be halved.
  [[nodiscard]] std::optional<std::size_t> halve(std::size_t number);

 private:
  // A joint between root and link. X_PJ is the pose of the joint's frame in the previous step's
  // frame, or in the world for the first step.
  struct Step {
    Eigen::Isometry3d X_PJ;
    Eigen::Vector3d axis;
    bool prismatic;
    double multiplier;
    double offset;
    std::size_t interval;
    double reach_m = 0.0;  // largest distance of the link from the frame's origin
  };
  struct PlacedStep {
    Eigen::Vector3d p;     // origin of the step's frame before its joint moves (world)
    Eigen::Vector3d axis;  // the joint's axis (world)
    // Returns the distance of a point from the axis.
    double far(const Eigen::Vector3d& point) const { return axis.cross(point - p).norm(); }
  };
  void add_steps(const Cell& cell, LinkId link, std::vector<JointId>& drivers);
  void add_intervals(const Cell& cell, const std::vector<JointId>& drivers, double beyond);
  void bound_reach();
  [[nodiscard]] double shift(const Step& step, const Part& part, double far_m) const;
  void place(Part& part) const;
  void enclose(Part& part, const std::vector<PlacedStep>& placed) const;

  std::vector<Step> steps_;
  Eigen::Isometry3d X_FL_ = Eigen::Isometry3d::Identity();  // pose in the last step's frame
  std::vector<LinkCapsule> capsules_;                       // in the link's frame
  std::vector<Part> parts_;
};

// least_m: lower bound of the distance of two parts for all their joint values. at_centers_m:
// distance of their capsules with all joints at the centers.
struct PartGap {
  double least_m;
  double at_centers_m;
};
[[nodiscard]] PartGap gap_between(const SweptLink::Part& a, const SweptLink::Part& b);

}  // namespace armloom
