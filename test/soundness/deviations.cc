#include "test/soundness/deviations.h"

#include <algorithm>

namespace armloom::soundness {
namespace {

constexpr double kNear_s = 0.05;

class Downhill {
 public:
  Downhill(bench::ExactScene& exact, const MovingPair& pair, const DeviationAttack& attack)
      : exact_(exact), pair_(pair), attack_(attack) {
    for (const Motion* motion : {&pair.candidate, &pair.other}) {
      for (const JointId joint : motion->trajectory->joints()) {
        joints_.push_back(joint.index());
        errors_.push_back(attack.tracking_errors.of(*exact.cell().joint(joint).arm));
      }
    }
  }

  double from(const PlaceOfPair& place, std::vector<double> share) {
    const double own_s = to_seconds(place.own_time);
    const double other_s = to_seconds(place.other_time);
    at_ = {own_s, other_s, std::move(share)};
    best_m_ = look(at_);
    for (double step_s = 0.2 * kNear_s; step_s > 1e-5;) {
      const double before_m = best_m_;
      turn_joints();
      for (const double off_s : {-step_s, step_s}) {
        State next = at_;
        next.own_s = within(own_s, next.own_s + off_s);
        keep(next);
        next = at_;
        next.other_s = within(other_s, next.other_s + off_s);
        keep(next);
      }
      if (best_m_ > before_m - 1e-7) step_s *= 0.5;
    }
    return best_m_;
  }
  [[nodiscard]] std::size_t joints() const { return joints_.size(); }

 private:
  struct State {
    double own_s = 0.0;
    double other_s = 0.0;
    std::vector<double> share;  // of the tracking error, by moving joint
  };

  static double within(double middle_s, double s) {
    return std::clamp(s, middle_s - kNear_s, middle_s + kNear_s);
  }

  void turn_joints() {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      for (const double share : {-1.0, 1.0}) {
        State next = at_;
        next.share[j] = share;
        keep(next);
      }
    }
  }

  void keep(const State& next) {
    const double found_m = look(next);
    if (found_m >= best_m_) return;
    best_m_ = found_m;
    at_ = next;
  }

  double look(const State& state) {
    q_ = exact_.cell().home();
    pair_.state_at(0.0, state.own_s - to_seconds(pair_.candidate.progress),
                   state.other_s - to_seconds(pair_.other.progress), q_);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      q_[static_cast<Eigen::Index>(joints_[j])] += errors_[j] * state.share[j];
    }
    return exact_.between_arms(q_, attack_.horizon_m);
  }

  bench::ExactScene& exact_;
  const MovingPair& pair_;
  DeviationAttack attack_;
  std::vector<std::size_t> joints_;
  std::vector<double> errors_;  // by index in joints_
  Configuration q_;
  State at_;
  double best_m_ = 0.0;
};

}  // namespace

double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair,
                               const PlaceOfPair& place, const DeviationAttack& attack,
                               std::mt19937_64& random) {
  Downhill downhill(exact, pair, attack);
  double closest_m = attack.horizon_m;
  for (int i = 0; i <= attack.throws; ++i) {
    std::vector<double> share(downhill.joints(), 0.0);
    if (i > 0) {
      for (double& s : share) s = uniform(random, -1.0, 1.0);
    }
    closest_m = std::min(closest_m, downhill.from(place, std::move(share)));
  }
  return closest_m;
}

}  // namespace armloom::soundness
