#include "test/soundness/truth.h"

#include <algorithm>
#include <cmath>

#include "core/collision/scene/scene_bodies.h"

namespace armloom::soundness {
namespace {

constexpr double kRounding_m = 1e-6;

// Bounds how far any point of a motion's arm travels from the question's time on.
class Odometer {
 public:
  Odometer(const Motion& motion, const std::vector<double>& levers)
      : motion_(motion), segments_(motion.trajectory->segments()) {
    const Trajectory& trajectory = *motion.trajectory;
    const std::vector<SegmentBounds> bounds = trajectory.bounds();
    travelled_m_.push_back(0.0);
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      double speed = 0.0;
      for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
        speed +=
            bounds[s].speed[static_cast<Eigen::Index>(j)] * levers[trajectory.joints()[j].index()];
      }
      speeds_m_s_.push_back(speed);
      travelled_m_.push_back(travelled_m_.back() + speed * to_seconds(segments_[s].duration));
    }
  }

  [[nodiscard]] double at(double t_s) const {
    const double progress_s = to_seconds(motion_.progress) + t_s;
    if (progress_s <= 0.0) return 0.0;
    if (progress_s >= to_seconds(motion_.trajectory->duration())) return travelled_m_.back();
    const auto after = std::upper_bound(
        segments_.begin(), segments_.end(), progress_s,
        [](double s, const Segment& segment) { return s < to_seconds(segment.start); });
    const auto i = static_cast<std::size_t>(after - segments_.begin()) - 1;
    return travelled_m_[i] + speeds_m_s_[i] * (progress_s - to_seconds(segments_[i].start));
  }

 private:
  const Motion& motion_;
  std::vector<Segment> segments_;
  std::vector<double> speeds_m_s_;
  std::vector<double> travelled_m_;  // at the beginning of each segment
};

void note(Truth& truth, double distance_m, double t_s, double clearance_m) {
  if (distance_m < truth.smallest_m) {
    truth.smallest_m = distance_m;
    truth.smallest_at_s = t_s;
  }
  if (distance_m < clearance_m && !truth.first_below_s) truth.first_below_s = t_s;
}

std::size_t samples(const MovingPair& pair) {
  return static_cast<std::size_t>(std::ceil(pair.span_s() / kSample_s));
}

}  // namespace

std::vector<double> longest_levers(const PlanningScene& scene) {
  const Cell& cell = scene.cell();
  std::vector<double> reach(cell.links.size(), 0.0);  // beyond the link's origin
  for (const CollisionBody& part : scene.bodies().bodies) {
    if (!part.carrier) continue;
    double& far = reach[part.carrier->index()];
    far = std::max(far, (part.X_CP * part.sphere.p_PC).norm() + part.sphere.radius_m);
  }
  std::vector<double> levers(cell.joints.size(), 0.0);
  for (std::size_t l = cell.links.size(); l-- > 0;) {  // parents come before children
    const Link& link = cell.links[l];
    double travel = 0.0;
    if (link.driver) {
      const Joint& joint = cell.joint(*link.driver);
      const bool slides = link.motion == JointKind::prismatic;
      if (slides) travel = std::max(std::abs(joint.lower), std::abs(joint.upper)) + link.offset;
      double& lever = levers[link.driver->index()];
      lever += std::abs(link.multiplier) * (slides ? 1.0 : reach[l]);
    }
    if (!link.parent) continue;
    double& of_parent = reach[link.parent->index()];
    of_parent = std::max(of_parent, link.X_PJ.translation().norm() + travel + reach[l]);
  }
  return levers;
}

TruthSampler::TruthSampler(bench::ExactScene& exact)
    : exact_(exact), levers_(longest_levers(*exact.scene)), q_(exact.cell().home()) {}

double TruthSampler::at(const MovingPair& pair, double t_s, double horizon_m) {
  pair.state_at(t_s, 0.0, 0.0, q_);
  return exact_.between_arms(q_, horizon_m);
}

Truth TruthSampler::of(const MovingPair& pair) {
  const double clearance_m = exact_.cell().clearances.clearance_m;
  const Odometer one(pair.candidate, levers_);
  const Odometer two(pair.other, levers_);
  const auto travelled = [&](std::size_t k) {
    const double t_s = static_cast<double>(k) * kSample_s;
    return one.at(t_s) + two.at(t_s);
  };
  const std::size_t count = samples(pair);
  double bound_m = kHorizon_m;
  std::size_t looked_at = 0;
  for (std::size_t k = 0; k <= count; k += 100, ++looked_at) {
    bound_m = std::min(bound_m, at(pair, static_cast<double>(k) * kSample_s, bound_m));
  }
  Truth truth{kHorizon_m, 0.0, std::nullopt, looked_at};
  for (std::size_t k = 0; k <= count;) {
    const double t_s = static_cast<double>(k) * kSample_s;
    const double smallest_m = std::min(bound_m, truth.smallest_m);
    const double matters_m = truth.first_below_s ? smallest_m : std::max(smallest_m, clearance_m);
    const double distance_m = at(pair, t_s, matters_m + 0.15);
    ++truth.looked_at;
    note(truth, distance_m, t_s, clearance_m);
    const double room_m = distance_m - matters_m - kRounding_m + travelled(k);
    std::size_t near = k + 1;
    std::size_t far = count + 1;
    while (near < far) {
      const std::size_t middle = near + (far - near) / 2;
      if (travelled(middle) < room_m) {
        near = middle + 1;
      } else {
        far = middle;
      }
    }
    k = near;
  }
  return truth;
}

Truth TruthSampler::of_every_sample(const MovingPair& pair) {
  Truth truth{kHorizon_m, 0.0, std::nullopt};
  for (std::size_t k = 0; k <= samples(pair); ++k, ++truth.looked_at) {
    const double t_s = static_cast<double>(k) * kSample_s;
    note(truth, at(pair, t_s, kHorizon_m), t_s, exact_.cell().clearances.clearance_m);
  }
  return truth;
}

}  // namespace armloom::soundness
