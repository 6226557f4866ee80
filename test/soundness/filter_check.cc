#include "test/soundness/filter_check.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/collision/filter/kernels.h"
#include "core/collision/filter/pair_set.h"
#include "core/collision/state/body_distance.h"
#include "core/model/cell/build_cell.h"
#include "core/model/kinematics.h"
#include "server/codec/cell_codec.h"
#include "test/soundness/pairs.h"
#include "test/soundness/plain_fcl.h"
#include "test/source_dir.h"

namespace armloom::soundness {
namespace {

constexpr std::size_t kLanes = filter::kLanes;
constexpr double kNear_m = 0.05;         // closer pairs are also compared with plain FCL
constexpr double kFclRounding_m = 1e-6;  // of FCL's own distances
constexpr float kFar_m = 1e3F;           // leaves every pair open

struct PlacedArm {
  explicit PlacedArm(const ArmKinematics& arm)
      : kinematics(arm),
        q(arm.joints().size() * kLanes),
        frames(arm.frames().size() * 12 * kLanes),
        axes(arm.frames().size() * 6 * kLanes),
        capsules(arm.capsules().size() * 6 * kLanes),
        still(static_cast<std::size_t>(arm.motion_bound_rows()) * kLanes, 0.0F) {}

  void put(const Configuration& state, std::size_t lane) {
    for (std::size_t row = 0; row < kinematics.joints().size(); ++row) {
      q[row * kLanes + lane] = state[static_cast<Eigen::Index>(kinematics.joints()[row].index())];
    }
  }
  void place() {
    filter::best_kernel().place(kinematics.view(), q.data(),
                                {frames.data(), axes.data(), capsules.data()});
  }
  [[nodiscard]] filter::Side side() const { return {capsules.data(), still.data()}; }

  const ArmKinematics& kinematics;
  std::vector<double> q, frames;
  std::vector<float> axes, capsules, still;
};

class Checker {
 public:
  Checker(const PlanningScene& scene, FilterReport& report)
      : bodies_(scene.bodies()), report_(report), plain_(bodies_), poses_(kLanes) {
    for (std::uint32_t a = 0; a < bodies_.cell->arms.size(); ++a) {
      linkages_.emplace_back(bodies_, ArmId{a});
    }
    linkages_.emplace_back(bodies_, std::nullopt);  // static bodies
    for (const ArmKinematics& kinematics : linkages_) arms_.emplace_back(kinematics);
    for (std::size_t a = 0; a + 1 < arms_.size(); ++a) {
      for (std::size_t b = a + 1; b + 1 < arms_.size(); ++b) {
        add(a, b);
      }
      add(a, a);
      add(a, arms_.size() - 1);
    }
    for (std::uint32_t i = 0; i < bodies_.pairs.size(); ++i) {
      report_.left_out += compared_.contains(PairId{i}) ? 0 : 1;
    }
  }

  void check(const std::vector<Configuration>& states) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (PlacedArm& arm : arms_) arm.put(states[lane], lane);
      forward_kinematics(*bodies_.cell, states[lane], poses_[lane]);
    }
    for (PlacedArm& arm : arms_) arm.place();
    for (const Set& set : sets_) compare(set);
    report_.states += kLanes;
  }

 private:
  struct Set {
    PairSet pairs;
    std::size_t a, b;
  };

  void add(std::size_t a, std::size_t b) {
    Set set{pairs_between(bodies_, linkages_[a], linkages_[b]), a, b};
    for (const NarrowPair& pair : set.pairs.narrow) compared_.insert(pair.pair);
    set.pairs.each_boxed([&](const NarrowPair& pair) { compared_.insert(pair.pair); });
    for (filter::Pair& pair : set.pairs.pairs) {
      const auto radius = [&](std::size_t arm, int capsule) {
        return linkages_[arm].capsules()[static_cast<std::size_t>(capsule)].radius_up;
      };
      const double margin =
          static_cast<double>(pair.radii_up) - radius(set.a, pair.a) - radius(set.b, pair.b);
      report_.margin_m = std::max(report_.margin_m, margin);
      pair.limit_up = kFar_m;
      pair.row_a = pair.row_b = 0;  // all rows are zero
    }
    for (filter::StaticBox& box : set.pairs.boxes) box.limit_up = kFar_m;
    for (filter::BoxedCapsule& capsule : set.pairs.boxed) capsule.row = 0;
    sets_.push_back(std::move(set));
  }

  void compare(const Set& set) {
    const filter::Kernel& kernel = filter::best_kernel();
    const filter::Side a = arms_[set.a].side();
    const filter::Side b = arms_[set.b].side();
    hits_.resize(set.pairs.hits_max() + 1);
    const int pairs = kernel.near_pairs(a, b, set.pairs.ungrouped(), 0xFF, hits_.data());
    if (static_cast<std::size_t>(pairs) != set.pairs.pairs.size()) {
      throw std::logic_error("the filter leaves out pairs that it was to tell");
    }
    least_.clear();
    collect(pairs, [&](const filter::Hit& hit) {
      return set.pairs.narrow[static_cast<std::size_t>(hit.pair)].pair;
    });
    collect(
        kernel.near_boxes(a, set.pairs.all_boxes(), 0xFF, hits_.data()),
        [&](const filter::Hit& hit) { return set.pairs.narrow_of(hit.pair, hit.capsule).pair; });
    for (const auto& [pair, distances] : least_) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) hold(pair, distances[lane], lane);
    }
  }

  template <class Pair>
  void collect(int count, const Pair& pair_of) {
    for (int h = 0; h < count; ++h) {
      const filter::Hit& hit = hits_[static_cast<std::size_t>(h)];
      auto& least =
          least_.try_emplace(pair_of(hit), std::vector<double>(kLanes, 1e9)).first->second;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        least[lane] = std::min(least[lane], static_cast<double>(hit.distance[lane]));
      }
    }
  }

  void hold(PairId id, double filter_m, std::size_t lane) {
    ++report_.part_pairs;
    if (filter_m <= 0.0) return;
    const BodyPair& pair = bodies_.pairs[id.index()];
    const auto pose = [&](std::size_t part) {
      const auto& link = bodies_.bodies[part].link;
      return link ? poses_[lane][link->index()] : bodies_.objects[part - bodies_.links_end].X_WO;
    };
    const double near_m = filter_m + kNear_m;
    const double exact_m = body_distance(bodies_.shapes, {bodies_.bodies[pair.a], pose(pair.a)},
                                         {bodies_.bodies[pair.b], pose(pair.b)}, near_m);
    if (exact_m < filter_m) fail(pair, "filter", filter_m, "exact", exact_m);
    if (filter_m > kNear_m) return;
    ++report_.by_fcl;
    const double fcl_m = plain_.distance(pair.a, pose(pair.a), pair.b, pose(pair.b));
    if (filter_m > fcl_m + kFclRounding_m) fail(pair, "filter", filter_m, "FCL", fcl_m);
    const bool known = exact_m > 0.0 && exact_m < near_m;
    if (known && exact_m > fcl_m + kFclRounding_m) fail(pair, "exact", exact_m, "FCL", fcl_m);
  }

  void fail(const BodyPair& pair, const char* what, double value_m, const char* against,
            double other_m) {
    ++report_.too_far;
    report_.worst_m = std::max(report_.worst_m, value_m - other_m);
    if (report_.failures.size() >= 5) return;
    std::ostringstream text;
    text << bodies_.bodies[pair.a].name << ", " << bodies_.bodies[pair.b].name << ": " << what
         << " " << value_m << ", " << against << " " << other_m;
    report_.failures.push_back(text.str());
  }

  const PlanningScene::Bodies& bodies_;
  FilterReport& report_;
  PlainFcl plain_;
  std::vector<LinkPoses> poses_;  // by lane
  std::vector<ArmKinematics> linkages_;
  std::vector<PlacedArm> arms_;
  std::vector<Set> sets_;
  std::vector<filter::Hit> hits_;
  std::set<PairId> compared_;
  std::map<PairId, std::vector<double>> least_;  // by lane
};

}  // namespace

FilterReport check_filter(const CellPtr& cell, std::size_t states, std::uint64_t seed) {
  FilterReport report;
  const PlanningScenePtr scene = PlanningScene::build(cell).value();
  Checker checker(*scene, report);
  std::mt19937_64 random(seed);
  std::vector<Configuration> batch(kLanes, cell->home());
  while (report.states < states) {
    for (Configuration& q : batch) {
      for (std::size_t j = 0; j < cell->joints.size(); ++j) {
        const Joint& joint = cell->joints[j];
        const bool turns = joint.kind == JointKind::continuous;
        q[static_cast<Eigen::Index>(j)] =
            uniform(random, turns ? -10.0 : joint.lower, turns ? 10.0 : joint.upper);
      }
    }
    checker.check(batch);
  }
  return report;
}

CellPtr cell_of_file(const std::string& name) {
  const std::string folder = source_dir() + "/config";
  std::ifstream file(folder + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  const auto cell = read_cell_text(text.str(), folder).and_then([](const CellDescription& read) {
    return build_cell(read);
  });
  if (!cell) throw std::runtime_error(name + ": " + cell.error().front().detail);
  return *cell;
}

}  // namespace armloom::soundness
