#include "test/soundness/deviations.h"

#include <algorithm>

namespace armloom::soundness {
namespace {

constexpr double kNear_s = 0.05;

class Downhill {
 public:
  Downhill(bench::ExactScene& exact, const MovingPair& pair, double tracking_error,
           double horizon_m)
      : exact_(exact), pair_(pair), error_(tracking_error), horizon_m_(horizon_m) {
    for (const Motion* motion : {&pair.candidate, &pair.other}) {
      for (const JointId joint : motion->trajectory->joints()) joints_.push_back(joint.index());
    }
  }

  double from(double own_s, double other_s, std::vector<double> share) {
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
    std::vector<double> share;  // of the error, by joint that moves
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
      q_[static_cast<Eigen::Index>(joints_[j])] += error_ * state.share[j];
    }
    return exact_.between_arms(q_, horizon_m_);
  }

  bench::ExactScene& exact_;
  const MovingPair& pair_;
  double error_;
  double horizon_m_;
  std::vector<std::size_t> joints_;
  Configuration q_;
  State at_;
  double best_m_ = 0.0;
};

}  // namespace

double closest_with_deviations(bench::ExactScene& exact, const MovingPair& pair, Duration own_time,
                               Duration other_time, double tracking_error, double horizon_m,
                               int throws, std::mt19937_64& random) {
  Downhill downhill(exact, pair, tracking_error, horizon_m);
  double closest_m = horizon_m;
  for (int i = 0; i <= throws; ++i) {
    std::vector<double> share(downhill.joints(), 0.0);
    if (i > 0) {
      for (double& s : share) s = uniform(random, -1.0, 1.0);
    }
    closest_m = std::min(
        closest_m, downhill.from(to_seconds(own_time), to_seconds(other_time), std::move(share)));
  }
  return closest_m;
}

}  // namespace armloom::soundness
