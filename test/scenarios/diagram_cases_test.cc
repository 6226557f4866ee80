#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

class DiagramOfJobs : public testing::Test {
 protected:
  // Requests the diagram and ticks until it arrives.
  Result<DiagramView> diagram(const std::string& a, const std::string& b) {
    std::optional<Result<DiagramView>> answer;
    crossing_.simulation->executive().inquiries().diagram(
        a, b, [&](Result<DiagramView> view) { answer = std::move(view); });
    for (int i = 0; i < 100 && !answer; ++i) crossing_.simulation->tick();
    if (!answer) throw std::runtime_error("no answer");
    return std::move(*answer);
  }

  Crossing crossing_{crossing_description(), "certified"};
};

// Both move from -1 m to 1 m in 2 s and pass the origin, where they are too close.
TEST_F(DiagramOfJobs, ShowsTheConflictAtTheOriginOnly) {
  crossing_.submit(slide("x", -1.0, 1.0, 2.0, "x"));
  crossing_.submit(slide("y", -1.0, 1.0, 2.0, "y"));
  const auto view = diagram("x", "y");
  ASSERT_TRUE(view);
  ASSERT_EQ(view->layers.size(), 1U);
  EXPECT_EQ(view->layers[0].arm_a, "x");
  EXPECT_EQ(view->layers[0].arm_b, "y");
  bool middle_conflicts = false;
  for (const DiagramCell& cell : view->layers[0].cells) {
    const bool middle =
        cell.from_a <= 1s && 1s <= cell.to_a && cell.from_b <= 1s && 1s <= cell.to_b;
    if (middle) middle_conflicts |= cell.state == DiagramCell::State::conflict;
    const bool early = cell.to_a <= 600ms || cell.to_b <= 600ms;
    const bool late = cell.from_a >= 1400ms || cell.from_b >= 1400ms;
    if (early || late) {
      EXPECT_EQ(cell.state, DiagramCell::State::free);
    }
  }
  EXPECT_TRUE(middle_conflicts);
}

TEST_F(DiagramOfJobs, DoesNotChangeVerdicts) {
  const auto run = [](bool look) {
    Crossing crossing(crossing_description(), "certified");
    crossing.submit(slide("x", -1.0, 1.0, 2.0, "x"));
    crossing.submit(slide("y", -1.0, 1.0, 3.0, "y"));
    bool drawn = false;
    if (look) {
      crossing.simulation->executive().inquiries().diagram(
          "x", "y", [&](const Result<DiagramView>& view) { drawn = view.has_value(); });
    }
    crossing.run_to_the_end();
    EXPECT_EQ(drawn, look);
    std::vector<std::pair<TimePoint, std::size_t>> told;
    for (const Event& event : crossing.log.events) {
      told.emplace_back(event.time, event.body.index());
    }
    return told;
  };
  EXPECT_EQ(run(false), run(true));
}

TEST_F(DiagramOfJobs, IsRefusedForUnknownJobs) {
  crossing_.submit(slide("x", -1.0, 1.0, 2.0, "x"));
  const auto view = diagram("x", "gone");
  ASSERT_FALSE(view);
  EXPECT_EQ(view.error().front().kind, ProblemKind::not_found);
  EXPECT_EQ(view.error().front().pointer, "?with");
}

}  // namespace
}  // namespace armloom
