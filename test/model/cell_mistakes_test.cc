#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Mistake {
  const char* name;
  std::function<void(CellDescription&)> make;
  const char* pointer;
  const char* sentence;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class CellMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CellMistake, IsTheOnlyProblemReportedWithPointerAndValue) {
  CellDescription description = two_arms_description();
  GetParam().make(description);
  const auto cell = build_cell(description);
  ASSERT_FALSE(cell.has_value()) << "accepted";
  ASSERT_EQ(cell.error().size(), 1u) << cell.error()[0].detail << "\n"
                                     << cell.error().back().detail;
  EXPECT_EQ(cell.error()[0].pointer, GetParam().pointer);
  EXPECT_THAT(cell.error()[0].detail, HasSubstr(GetParam().sentence));
}

#define MISTAKE(statement, pointer, sentence)                                \
  Mistake {                                                                  \
#statement, [](CellDescription & cell) { statement; }, pointer, sentence \
  }

ArmDescription& left(CellDescription& cell) { return cell.robots[0].arms[0]; }

INSTANTIATE_TEST_SUITE_P(
    Settings, CellMistake,
    testing::Values(
        MISTAKE(cell.clearance_m = -0.01;
                cell.monitor.stop_clearance_m = 0, "/clearance_m",
                "clearance_m is -0.01, it must be at least 0 and at most 1"),
        MISTAKE(cell.clearance_m = kNaN, "/clearance_m", "clearance_m is nan"),
        MISTAKE(left(cell).name = "a/b", "/robots/0/arms/0/name",
                "the name of an arm is used in API paths: a name is 1 to 128 characters without "
                "slashes and control characters, and not . or .."),
        MISTAKE(left(cell).name = "..", "/robots/0/arms/0/name", "and not . or .."),
        MISTAKE(cell.checking.time_step = 0s, "/checking/time_step_s",
                "time_step_s is 0, it must be at least 1e-04 and at most 10"),
        MISTAKE(cell.checking.tracking_error_rad = -1, "/checking/tracking_error_rad",
                "it must be at least 0 and at most 1"),
        MISTAKE(cell.checking.delay = -1ms, "/checking/delay_s", "delay_s is -0.001"),
        MISTAKE(cell.checking.limit_tolerance = 1, "/checking/limit_tolerance",
                "at least 0 and less than 1"),
        MISTAKE(cell.scheduling.backlog_timeout = 0s, "/scheduling/backlog_timeout_s",
                "it must be greater than 0 and at most 1e+06"),
        MISTAKE(cell.scheduling.aging = -1s, "/scheduling/aging_s", "aging_s is -1"),
        MISTAKE(cell.monitor.rate_hz = 0, "/monitor/rate_hz", "at least 1 and at most 1000"),
        MISTAKE(cell.monitor.rate_hz = 1001, "/monitor/rate_hz", "rate_hz is 1001"),
        MISTAKE(cell.monitor.rate_hz = kNaN, "/monitor/rate_hz", "rate_hz is nan"),
        MISTAKE(cell.monitor.reaction = -1ms, "/monitor/reaction_s", "at least 0"),
        MISTAKE(cell.monitor.stop_clearance_m = 0.03, "/monitor/stop_clearance_m",
                "stop_clearance_m is 0.03, it must be at most clearance_m (0.02 m)"),
        MISTAKE(cell.execution.start_tolerance_rad = 0, "/execution/start_tolerance_rad",
                "greater than 0"),
        MISTAKE(cell.execution.duration_scaling = 0.9, "/execution/duration_scaling",
                "duration_scaling is 0.9, it must be at least 1 and at most 100"),
        MISTAKE(cell.execution.velocity_scaling_factor = 0, "/execution/velocity_scaling_factor",
                "velocity_scaling_factor is 0, it must be at least 0.001 and at most 1"),
        MISTAKE(cell.execution.velocity_scaling_factor = 1.5, "/execution/velocity_scaling_factor",
                "velocity_scaling_factor is 1.5, it must be"),
        MISTAKE(cell.execution.duration_margin = -1s, "/execution/duration_margin_s", "at least 0"),
        MISTAKE(cell.robots[0].controller.feedback_period = 60ms,
                "/robots/0/controller/feedback_timeout_s",
                "feedback_timeout_s is 0.1, it must be at least twice feedback_period_s (0.06 s)"),
        MISTAKE(cell.robots[0].controller.lag = -1ms, "/robots/0/controller/lag_s",
                "lag_s is -0.001"),
        MISTAKE(cell.robots[0].controller.noise_rad = -0.1, "/robots/0/controller/noise_rad",
                "noise_rad is -0.1")));

namespace {
void set_endpoint(CellDescription& cell, const char* type, const char* endpoint) {
  cell.robots[0].controller.type = type;
  cell.robots[0].controller.endpoint = endpoint;
}
// Adds the robot again, with other names and the same endpoint.
void share_endpoint(CellDescription& cell) {
  set_endpoint(cell, "remote", "unix:/tmp/twin");
  RobotDescription other = cell.robots[0];
  other.name = "other";
  other.prefix = "o_";
  for (ArmDescription& arm : other.arms) arm.name = "other_" + arm.name;
  other.X_WB.translation().x() += 5.0;
  other.controller.endpoint = "unix:/tmp//twin";
  cell.robots.push_back(other);
}
}  // namespace

INSTANTIATE_TEST_SUITE_P(
    Endpoints, CellMistake,
    testing::Values(MISTAKE(set_endpoint(cell, "remote", ""), "/robots/0/controller",
                            "a remote controller needs its endpoint: unix:PATH or tcp:HOST:PORT"),
                    MISTAKE(set_endpoint(cell, "sim", "unix:/tmp/left"),
                            "/robots/0/controller/endpoint",
                            "a controller of type sim has no endpoint"),
                    MISTAKE(set_endpoint(cell, "remote", "/tmp/left"),
                            "/robots/0/controller/endpoint", "expected unix:PATH or tcp:HOST:PORT"),
                    MISTAKE(set_endpoint(cell, "remote", "unix:"), "/robots/0/controller/endpoint",
                            "the path is missing"),
                    MISTAKE(set_endpoint(cell, "remote", "tcp:10.0.0.7"),
                            "/robots/0/controller/endpoint", "host or port is missing"),
                    MISTAKE(set_endpoint(cell, "remote", "tcp:10.0.0.7:70000"),
                            "/robots/0/controller/endpoint", "not a number from 0 to 65535"),
                    MISTAKE(set_endpoint(cell, "remote", "tcp:10.0.0.7:0"),
                            "/robots/0/controller/endpoint", "cannot connect to port 0"),
                    MISTAKE(set_endpoint(cell, "remote", "tcp:::1:4000"),
                            "/robots/0/controller/endpoint", "an IPv6 address stands in brackets"),
                    MISTAKE(share_endpoint(cell), "/robots/1/controller/endpoint",
                            "the endpoint unix:/tmp//twin is also that of robot twin "
                            "(/robots/0/controller/endpoint)")));

INSTANTIATE_TEST_SUITE_P(
    Arms, CellMistake,
    testing::Values(MISTAKE(left(cell).home = {0.3}, "/robots/0/arms/0/home",
                            "home has 1 values, the group has 2 joints"),
                    MISTAKE(left(cell).home[1] = 2.6, "/robots/0/arms/0/home/1",
                            "home of t_l_turn is 2.6, outside [-2, 2.5] rad"),
                    MISTAKE(left(cell).home[0] = 0.05, "/robots/0/arms/0/home/0",
                            "home of t_l_slide is 0.05, outside [0.1, 0.7] m"),
                    MISTAKE(left(cell).home[1] = kNaN, "/robots/0/arms/0/home/1",
                            "home of t_l_turn is nan"),
                    MISTAKE(cell.robots[0].arms[1].home = (std::vector<double>{kInfinity, 1, 0}),
                            "/robots/0/arms/1/home/0", "home of t_r_spin is inf"),
                    MISTAKE(left(cell).group = "hand", "/robots/0/arms/0/group",
                            "group 'hand' is not in two_arms.srdf"),
                    MISTAKE(left(cell).limits["r_spin"], "/robots/0/arms/0/limits/r_spin",
                            "arm left has no joint r_spin to limit"),
                    MISTAKE(left(cell).limits["a/b~c"], "/robots/0/arms/0/limits/a~1b~0c",
                            "arm left has no joint a/b~c"),
                    MISTAKE(left(cell).limits["l_grip_mirror"],
                            "/robots/0/arms/0/limits/l_grip_mirror", "no joint l_grip_mirror"),
                    MISTAKE(left(cell).limits["l_turn"].acceleration = 0,
                            "/robots/0/arms/0/limits/l_turn/acceleration_rad_s2",
                            "acceleration_rad_s2 is 0, it must be greater than 0"),
                    MISTAKE(left(cell).limits["l_turn"].jerk = kInfinity,
                            "/robots/0/arms/0/limits/l_turn/jerk_rad_s3", "jerk_rad_s3 is inf"),
                    MISTAKE(left(cell).limits["l_turn"].brake = kNaN,
                            "/robots/0/arms/0/limits/l_turn/brake_rad_s2", "brake_rad_s2 is nan")));

INSTANTIATE_TEST_SUITE_P(
    Names, CellMistake,
    testing::Values(
        MISTAKE(cell.robots[0].name = "", "/robots/0/name", "the name of a robot is empty"),
        MISTAKE(cell.robots[0].arms[1].name = "left", "/robots/0/arms/1/name",
                "the name left of an arm is already taken"),
        MISTAKE(cell.objects.push_back(cell.objects[0]), "/objects/1/name",
                "the name table of an object is already taken"),
        MISTAKE(cell.objects[0].name = "t_post", "/objects/0/name",
                "the name t_post of an object is also a link's name"),
        MISTAKE(cell.objects[0].name = cell.robots[0].name, "/objects/0/name",
                "of an object is also a robot's name"),
        MISTAKE(cell.robots[0].arms.clear(), "/robots/0/arms", "no robot of the cell has an arm"),
        MISTAKE(cell.robots.clear(), "/robots", "the cell has no robot"),
        MISTAKE(cell.allowed_collisions.emplace_back("t_post", "chair"), "/allowed_collisions/0/1",
                "there is no link or object chair"),
        MISTAKE(cell.allowed_collisions.emplace_back("post", "table"), "/allowed_collisions/0/0",
                "there is no link or object post"),
        MISTAKE(cell.allowed_collisions.emplace_back("t_post", "t_post"), "/allowed_collisions/0",
                "t_post is named twice"),
        MISTAKE(cell.allowed_collisions.emplace_back("table", "table"), "/allowed_collisions/0",
                "are both objects")));

INSTANTIATE_TEST_SUITE_P(
    Geometry, CellMistake,
    testing::Values(MISTAKE(cell.robots[0].X_WB.translation().x() = kNaN, "/robots/0/base",
                            "robot twin: base: the pose holds a number that is not finite"),
                    MISTAKE(cell.robots[0].X_WB.linear() *= 2, "/robots/0/base",
                            "not a rotation and a translation"),
                    MISTAKE(cell.objects[0].X_WO.translation().x() = kInfinity, "/objects/0",
                            "object table: the pose holds"),
                    MISTAKE(cell.objects[0].shape = (Box{{1, 0, 1}}), "/objects/0/box/1",
                            "box side is 0 m, it must be greater than 0"),
                    MISTAKE(cell.objects[0].shape = (Cylinder{-1, 1}), "/objects/0/cylinder/0",
                            "cylinder radius is -1 m"),
                    MISTAKE(cell.objects[0].shape = (Cylinder{1, kNaN}), "/objects/0/cylinder/1",
                            "cylinder length is nan m"),
                    MISTAKE(cell.objects[0].shape = Sphere{kInfinity}, "/objects/0/sphere/0",
                            "sphere radius is inf m"),
                    MISTAKE(cell.objects[0].shape = Mesh{"missing.stl"}, "/objects/0/mesh",
                            "mesh missing.stl is not a file that exists")));

// Adds a device and an output of it.
SignalDescription& output(CellDescription& cell) {
  cell.io.devices = {{.name = "plc", .endpoint = "tcp:plc:502"}};
  cell.io.signals = {{.name = "valve",
                      .direction = SignalDirection::output,
                      .place = SignalDescription::Place{"plc", ModbusTable::coil, 3}}};
  return cell.io.signals.front();
}

INSTANTIATE_TEST_SUITE_P(
    Io, CellMistake,
    testing::Values(
        MISTAKE(output(cell); cell.io.devices[0].endpoint = "unix:/tmp/plc",
                              "/io/devices/0/endpoint", "must be tcp:HOST:PORT"),
        MISTAKE(output(cell); cell.io.devices.push_back(cell.io.devices[0]);
                cell.io.devices.back().unit = 2, "/io/devices/1/name",
                "the name plc of an I/O device is already taken"),
        MISTAKE(output(cell).place->device = "plx", "/io/signals/0/modbus/device",
                "there is no I/O device plx in /io/devices; did you mean plc?"),
        MISTAKE(output(cell).place->table = ModbusTable::input_register,
                "/io/signals/0/modbus/table", "no client can write to input_register: use coil"),
        MISTAKE(output(cell).direction = SignalDirection::input;
                cell.io.signals[0].fail_state = true, "/io/signals/0/fail_state",
                "is an input, so it has no fail_state"),
        MISTAKE(output(cell).fail_state = std::uint16_t{7}, "/io/signals/0/fail_state",
                "has the type bool, so this must be true or false"),
        MISTAKE(output(cell).initial = true, "/io/signals/0/initial", "remove initial"),
        MISTAKE(output(cell).type = SignalType::boolean, "/io/signals/0/type", "remove type"),
        MISTAKE(output(cell).place.reset(); cell.io.signals[0].fail_state = true,
                                            "/io/signals/0/fail_state", "set initial instead"),
        MISTAKE(output(cell); cell.io.signals.push_back(
                                  {"lamp", SignalDirection::input, {}, cell.io.signals[0].place}),
                              "/io/signals/1/modbus/address",
                              "same device, table and address as signal valve"),
        MISTAKE(output(cell).name = "a/b", "/io/signals/0/name", "used in API paths")));

TEST(CellNames, DuplicatesOfTwoRobotsAreReportedOncePerKind) {
  CellDescription cell = two_pandas_description();
  cell.allowed_collisions.clear();
  cell.robots[1].prefix = "left_";
  const auto built = build_cell(cell);
  ASSERT_FALSE(built.has_value());
  ASSERT_EQ(built.error().size(), 2u);
  EXPECT_EQ(built.error()[0].pointer, "/robots/1/prefix");
  EXPECT_THAT(built.error()[0].detail,
              HasSubstr("robot right: another robot also has a link named left_panda_hand"));
  EXPECT_THAT(built.error()[1].detail,
              HasSubstr("another robot also has a joint named left_panda_finger_joint1"));
}

TEST(CellProblems, ProblemsOfDifferentKindsAreAllReported) {
  CellDescription cell = two_arms_description();
  cell.monitor.rate_hz = -5;
  left(cell).home = {0, 0, 0};
  cell.allowed_collisions.emplace_back("here", "there");
  const std::string problems = problems_of(cell);
  EXPECT_THAT(problems, HasSubstr("/monitor/rate_hz | "));
  EXPECT_THAT(problems, HasSubstr("/robots/0/arms/0/home | "));
  EXPECT_THAT(problems, HasSubstr("/allowed_collisions/0/0 | "));
  EXPECT_THAT(problems, HasSubstr("/allowed_collisions/0/1 | "));
}

}  // namespace
}  // namespace armloom
