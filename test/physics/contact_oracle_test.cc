#include "server/physics/contact_oracle.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "core/audit/audited_cell.h"
#include "core/geometry/convex/convex_shape.h"
#include "core/geometry/convex/exact_distance.h"
#include "core/model/kinematics.h"
#include "test/physics/physics_cells.h"

namespace armloom::test {
namespace {

TEST(ContactOracle, PosesAgreeWithOurKinematics) {
  std::mt19937_64 random(1);
  const auto names = config_cell_names();
  ASSERT_GE(names.size(), 5u);
  for (const std::string& name : names) {
    const CellPtr cell = config_cell(name);
    auto oracle = ContactOracle::create(cell);
    ASSERT_TRUE(oracle.has_value());
    LinkPoses X_WL;
    double worst = 0.0;
    for (int i = 0; i < 50; ++i) {
      const Configuration q = random_configuration(*cell, random);
      forward_kinematics(*cell, q, X_WL);
      (void)oracle->contacts(q);
      for (std::size_t l = 0; l < cell->links.size(); ++l) {
        const Eigen::Matrix4d difference =
            oracle->pose(cell->links[l].name).matrix() - X_WL[l].matrix();
        worst = std::max(worst, difference.cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT(worst, 1e-6) << name;
  }
}

TEST(ContactOracle, HomesOfConfiguredCellsHaveNoContact) {
  for (const std::string& name : config_cell_names()) {
    const CellPtr cell = config_cell(name);
    auto oracle = ContactOracle::create(cell);
    ASSERT_TRUE(oracle.has_value());
    for (const BodyContact& contact : oracle->contacts(cell->home())) {
      ADD_FAILURE() << name << ": " << contact.body_a << " touches " << contact.body_b;
    }
  }
}

bool contains(const std::vector<BodyContact>& contacts, const std::string& a,
              const std::string& b) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const BodyContact& contact) {
    return (contact.body_a == a && contact.body_b == b) ||
           (contact.body_a == b && contact.body_b == a);
  });
}

TEST(ContactOracle, OmitsObjectsThatALinkMayTouch) {
  Cell cell = *config_cell("two_pandas");
  LinkPoses X_WL;
  forward_kinematics(cell, cell.home(), X_WL);
  const LinkId hand = *cell.find_link("left_panda_hand");
  cell.objects.push_back({"ball", Sphere{0.03}, X_WL[hand.index()]});
  auto touching = ContactOracle::create(std::make_shared<const Cell>(cell));
  ASSERT_TRUE(touching.has_value());
  EXPECT_TRUE(contains(touching->contacts(cell.home()), "left_panda_hand", "ball"));
  cell.allowed.link_objects.insert({hand, "ball"});
  auto allowed = ContactOracle::create(std::make_shared<const Cell>(cell));
  ASSERT_TRUE(allowed.has_value());
  EXPECT_FALSE(contains(allowed->contacts(cell.home()), "left_panda_hand", "ball"));
}

// Distances below this, of either sign, are not compared: MuJoCo stores meshes as floats, and its
// contact search has a tolerance.
constexpr double kBand_m = 5e-4;

// Returns the distance of the convex pieces of two links. MuJoCo knows only these, and those of a
// mesh fill some of its concave parts.
double distance_of_pieces(const Cell& cell, const Configuration& q, const std::string& a,
                          const std::string& b) {
  LinkPoses X_WL;
  forward_kinematics(cell, q, X_WL);
  const LinkId link_a = cell.find_link(a).value();
  const LinkId link_b = cell.find_link(b).value();
  double smallest = std::numeric_limits<double>::infinity();
  for (const ConvexShape& x : make_convex_shapes(cell.link(link_a).shapes)) {
    for (const ConvexShape& y : make_convex_shapes(cell.link(link_b).shapes)) {
      smallest = std::min(smallest, exact_distance(x, X_WL[link_a.index()] * x.X_PS, y,
                                                   X_WL[link_b.index()] * y.X_PS));
    }
  }
  return smallest;
}

TEST(ContactOracle, AgreesWithTheAuditOnRandomStates) {
  std::mt19937_64 random(2);
  for (const char* name : {"two_pandas", "dual_panda", "panda_and_ur5e", "two_shuttles"}) {
    const CellPtr cell = config_cell(name);
    auto oracle = ContactOracle::create(cell);
    auto audited = AuditedCell::build(*cell);
    ASSERT_TRUE(oracle.has_value() && audited.has_value());
    std::size_t touching = 0;
    std::size_t early = 0;
    double gap_m = 0.0;  // largest, of pairs that touch only in MuJoCo
    std::size_t apart = 0;
    for (int i = 0; i < 200; ++i) {
      const Configuration q = random_configuration(*cell, random);
      const auto deep = oracle->contacts(q);
      const auto near = oracle->contacts(q, kBand_m);
      audited->move_to(*cell, q);
      std::size_t deep_in_pairs = 0;
      for (AuditedPair& pair : audited->pairs()) {
        const std::string& a = audited->solid(pair.a).name;
        const std::string& b = audited->solid(pair.b).name;
        const double distance_m = audited->look(pair, kBand_m);
        const bool is_deep = contains(deep, a, b);
        deep_in_pairs += is_deep ? 1 : 0;
        (distance_m > 0.0 ? apart : touching) += 1;
        if (distance_m > kBand_m && is_deep) {
          ++early;
          gap_m = std::max(gap_m, audited->look(pair, 0.1));
          EXPECT_LE(distance_of_pieces(*cell, q, a, b), kBand_m)
              << name << " state " << i << ": only MuJoCo finds a contact of " << a << " and " << b
              << ", which are " << distance_m << " m apart";
        }
        EXPECT_FALSE(distance_m <= 0.0 && !contains(near, a, b))
            << name << " state " << i << ": only the audit finds a contact of " << a << " and "
            << b;
      }
      EXPECT_EQ(deep_in_pairs, deep.size()) << "MuJoCo reports a pair that the audit allows";
    }
    std::printf("%s: %zu pairs touch, %zu do not, %zu touch only in MuJoCo (%.1f mm apart)\n", name,
                touching, apart, early, 1e3 * gap_m);
    EXPECT_GT(touching, 100u) << name;
  }
}

}  // namespace
}  // namespace armloom::test
