#include "test/scheduler/random_world.h"

namespace armloom {

World::World(std::uint64_t seed, const std::string& policy, Disturbances disturbances)
    : random_(seed),
      disturbances_(disturbances),
      arms_(2 + random_() % 3),
      bench_(
          cell(), std::move(*make_policy(policy, *cell())), Crossings(table()),
          [this](JobId) { return habits(); }, seed) {}

void World::run(const std::function<void()>& look) {
  const auto count = 4 + random_() % 12;
  const bool at_once = random_() % 2 == 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (auto job = draw(disturbances_.crowds)) submit(std::move(*job));
    disturb();
    if (!at_once) bench_.run_until(bench_.now() + up_to(3s));
    look();
  }
  for (int i = 0; i < 6; ++i) {
    disturb();
    bench_.run_until(bench_.now() + up_to(10s));
    look();
  }
  resume();
  if (disturbances_.scenes) change_scene({});
  bench_.run();
}

CellPtr World::cell() {
  if (cell_) return cell_;
  auto made = std::make_shared<Cell>(
      *(disturbances_.parks ? one_joint_arms_that_park(arms_) : one_joint_arms(arms_)));
  made->execution.duration_margin = 1h;  // stalls must not cause overruns here
  made->execution.start_tolerance_rad = 1e-7;
  made->scheduling.horizon_steps = 1 + static_cast<int>(arms_ + random_() % 5) % 6;
  return cell_ = made;
}

Duration World::up_to(Duration most) {
  return Duration(static_cast<Duration::rep>(random_() % static_cast<std::uint64_t>(most.count())));
}

// Returns random crossings of each two arms. Both arms are free at home, at 0.
std::vector<Crossing> World::table() {
  std::vector<Crossing> table;
  for (std::uint32_t a = 0; a < arms_; ++a) {
    for (std::uint32_t b = a + 1; b < arms_; ++b) {
      for (auto n = random_() % 4; n > 0; --n) {
        const double size_a = 0.02 + 0.2 * place(), size_b = 0.02 + 0.2 * place();
        const double from_a = place() - 0.095,
                     from_b = place() - 0.095;  // no position is on an edge
        if (from_a <= 0.0 && from_b <= 0.0) continue;
        table.push_back({ArmId{a}, from_a, from_a + size_a, ArmId{b}, from_b, from_b + size_b});
      }
    }
  }
  return table;
}

Habits World::habits() {
  Habits habits{.brakes_for = up_to(200ms)};
  if (!disturbances_.delays) return habits;
  if (random_() % 2 == 0) habits.starts_late = up_to(10s);
  if (random_() % 2 == 0) habits.speed = 0.1 + 0.9 * place();
  habits.feedback_age = up_to(100ms);
  if (random_() % 4 == 0) {
    habits.stalls_at = up_to(2s);
    habits.stalls_for = up_to(30s);
  }
  return habits;
}

std::optional<Submit> World::draw(bool any) {
  const Configuration rest = predicted_rest(bench_.scheduler.state());
  for (int tries = 0; tries < 30; ++tries) {
    if (disturbances_.choices && random_() % 2 == 0) {
      if (auto job = draw_visit(rest, any)) return job;
      continue;
    }
    if (disturbances_.goals && random_() % 2 == 0) return draw_goal(rest);
    std::vector<std::uint32_t> arms{static_cast<std::uint32_t>(random_() % arms_)};
    const auto second = static_cast<std::uint32_t>(random_() % arms_);
    if (random_() % 6 == 0 && second > arms[0]) arms.push_back(second);
    std::vector<double> from, to;
    for (const std::uint32_t arm : arms) {
      from.push_back(rest[arm]);
      to.push_back(random_() % 4 == 0 ? 0.0 : place());
    }
    if (from == to) continue;
    const bool is_brought = disturbances_.goals && random_() % 3 == 0;
    if (is_brought) from.front() = place();
    const auto motion = move(arms, from, to, 500ms + up_to(4s));
    if (!any && !bench_.crossings.free_beside(*motion, rest)) continue;
    Submit job{JobId{0}, motion, {static_cast<int>(random_() % 3), 1'000'000s}};
    if (disturbances_.cancels) job.terms.backlog_timeout = 20s + up_to(100s);
    if (is_brought) job.terms.move_to_start = MoveToStart::plan;
    const auto active = bench_.scheduler.active();
    if (!active.empty() && random_() % 5 == 0) {
      job.after.push_back(active[random_() % active.size()]);
    }
    return job;
  }
  return std::nullopt;
}

std::optional<Submit> World::draw_visit(const Configuration& rest, bool any) {
  const bool by_any = random_() % 2 == 0;
  const auto first = static_cast<std::uint32_t>(random_() % arms_);
  Submit job{JobId{0}, nullptr, {static_cast<int>(random_() % 2), 1'000'000s}};
  if (disturbances_.cancels) job.terms.backlog_timeout = 20s + up_to(100s);
  for (std::uint32_t arm = by_any ? 0 : first; arm < (by_any ? arms_ : first + 1); ++arm) {
    const auto motion = visit(arm, rest[arm], place(), 1s + up_to(4s));
    if (any || bench_.crossings.free_beside(*motion, rest)) job.alternatives.push_back(motion);
  }
  if (job.alternatives.empty()) return std::nullopt;
  job.trajectory = job.alternatives.front();
  if (job.alternatives.size() == 1) job.alternatives.clear();
  job.terms.reorderable = true;
  return job;
}

std::optional<Submit> World::draw_goal(const Configuration& rest) {
  Submit job{JobId{0}, nullptr, {static_cast<int>(random_() % 3), 1'000'000s}};
  if (disturbances_.cancels) job.terms.backlog_timeout = 20s + up_to(100s);
  const bool by_any = random_() % 2 == 0, is_pose = random_() % 2 == 0;
  const auto one = static_cast<std::uint32_t>(random_() % arms_);
  for (std::uint32_t arm = by_any ? 0 : one; arm < (by_any ? arms_ : one + 1); ++arm) {
    const double to = place();
    MotionGoal goal{.arm = ArmId{arm}, .to = Eigen::VectorXd::Constant(1, to)};
    if (is_pose) {
      LinkTarget target{.link = LinkId{arm}, .X_WL = Eigen::Isometry3d::Identity()};
      target.X_WL.translation().x() = to;
      goal.to = target;
    }
    job.goals.push_back(std::move(goal));
    job.alternatives.push_back(move({arm}, rest[arm], to, 1s));
  }
  job.trajectory = job.alternatives.front();
  if (job.alternatives.size() == 1) job.alternatives.clear();
  return job;
}

JobId World::submit(Submit job) {
  jobs.push_back(bench_.submit(std::move(job)));
  return jobs.back();
}

void World::disturb() {
  const auto dice = random_() % 8;
  const ArmId arm{static_cast<std::uint32_t>(random_() % arms_)};
  const bool stops = disturbances_.stops || disturbances_.pauses;
  if (stops && dice == 0) stop(disturbances_.pauses ? all() : std::vector{arm});
  if (stops && dice < 3 && dice > 0) resume();
  const auto active = bench_.scheduler.active();
  if (disturbances_.cancels && dice == 3 && !active.empty()) {
    bench_.input(Cancel{active[random_() % active.size()]});
  }
  if (disturbances_.amends && dice >= 5 && !active.empty()) {
    Amend amend{active[random_() % active.size()], {static_cast<int>(random_() % 3)}};
    if (disturbances_.cancels) amend.terms.backlog_timeout = 20s + up_to(100s);
    bench_.input(amend);
  }
  if (disturbances_.scenes && dice == 4) {
    const double from = place() + 0.005;
    change_scene({{arm, from, from + 0.1 * place()}});
  }
}

std::vector<ArmId> World::all() const {
  std::vector<ArmId> arms;
  for (std::uint32_t arm = 0; arm < arms_; ++arm) arms.emplace_back(arm);
  return arms;
}

void World::stop(const std::vector<ArmId>& arms) {
  bench_.input(Stop{arms, "operator"});
  stopped_.insert(arms.begin(), arms.end());
}

void World::resume() {
  bench_.input(Resume{{stopped_.begin(), stopped_.end()}});
  stopped_.clear();
}

void World::change_scene(std::vector<Object> objects) {
  bench_.crossings.put(std::move(objects));
  SceneChanged changed;
  for (std::uint32_t arm = 0; arm < cell_->arms.size(); ++arm) changed.arms.emplace_back(arm);
  bench_.input(changed);
}

}  // namespace armloom
