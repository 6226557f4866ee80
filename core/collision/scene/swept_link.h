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

// Capsules that cover a link at all values of its joints: a tree of parts, each for a box of joint
// values, halved on request. Joints of no arm stay at home. Not thread-safe.
class SweptLink {
 public:
  // Joint values from center - half to center + half.
  struct Interval {
    double center = 0.0;
    double half = 0.0;
  };
  // The link's capsules with all joints at their centers, a bound of their motion within the
  // intervals, and a ball around the link for all these values.
  struct Part {
    std::vector<Interval> intervals;
    struct Segment {
      CenteredSegment line;
      double radius_m;
    };
    std::vector<Segment> capsules;
    double motion_m = 0.0;
    Ball ball;
    std::size_t widest = 0;  // interval that moves the link most
    std::size_t halves = 0;  // first half, the second is next; 0: none
  };
  static constexpr std::size_t kPartsMax = 4096;
  static constexpr double kFinest_m = 1e-3;  // parts that move less are not halved

  // `beyond`: how far joints may exceed their limits (rad or m).
  SweptLink(const PlanningScene::Bodies& bodies, LinkId link, double beyond);

  // Part 0 covers all joint values.
  [[nodiscard]] const Part& part(std::size_t number) const { return parts_[number]; }
  // Returns the first half's number; nullopt if the part cannot be halved.
  [[nodiscard]] std::optional<std::size_t> halve(std::size_t number);

 private:
  // A joint between root and link. X_PJ: its frame in the previous step's frame, or in the world.
  struct Step {
    Eigen::Isometry3d X_PJ;
    Eigen::Vector3d axis;
    bool prismatic;
    double multiplier;
    double offset;
    std::size_t interval;
    double reach_m = 0.0;  // farthest point of the link from the frame's origin
  };
  struct PlacedStep {
    Eigen::Vector3d p;     // the frame's origin, before its joint moves
    Eigen::Vector3d axis;  // in the world
    double far(const Eigen::Vector3d& point) const { return axis.cross(point - p).norm(); }
  };
  void add_steps(const Cell& cell, LinkId link, std::vector<JointId>& drivers);
  void add_intervals(const Cell& cell, const std::vector<JointId>& drivers, double beyond);
  void bound_reach();
  [[nodiscard]] double shift(const Step& step, const Part& part, double far_m) const;
  void place(Part& part) const;
  void enclose(Part& part, const std::vector<PlacedStep>& placed) const;

  std::vector<Step> steps_;
  Eigen::Isometry3d X_FL_ = Eigen::Isometry3d::Identity();  // in the last step's frame
  std::vector<LinkCapsule> capsules_;                       // in the link
  std::vector<Part> parts_;
};

// Lower bound of the distance of two parts, and the distance of their capsules with joints at the
// centers.
struct PartGap {
  double least_m;
  double at_centers_m;
};
[[nodiscard]] PartGap gap_between(const SweptLink::Part& a, const SweptLink::Part& b);

}  // namespace armloom
