#include <gmock/gmock.h>

#include "test/model/urdf_text.h"

namespace armloom {
namespace {

using testing::HasSubstr;

struct Mistake {
  const char* from;
  const char* to;
  const char* place;
  const char* sentence;
  int line = 0;  // line that must be reported; 0 for the changed line
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.from << " -> " << mistake.to;
}

class UrdfMistake : public testing::TestWithParam<Mistake> {};

TEST_P(UrdfMistake, IsTheOnlyProblemReportedWithPlaceAndValue) {
  const Mistake& mistake = GetParam();
  const ScratchFolder folder;
  const std::string sound = file_with(data_file("two_arms.urdf"), "</robot>", "</robot>");
  const std::string text = file_with(data_file("two_arms.urdf"), mistake.from, mistake.to);
  const auto cell = build_cell(cell_with_urdf(folder, text));
  ASSERT_FALSE(cell.has_value()) << mistake.to << " was accepted";
  ASSERT_EQ(cell.error().size(), 1u) << cell.error()[0].detail << "\n"
                                     << cell.error().back().detail;
  EXPECT_EQ(without_lines(cell.error()[0].pointer), mistake.place);
  const int line = line_of(cell.error()[0].pointer);
  if (line != 0) {
    EXPECT_EQ(line, mistake.line != 0 ? mistake.line : line_of_change(sound, text));
  }
  EXPECT_THAT(cell.error()[0].detail, HasSubstr(mistake.sentence));
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, UrdfMistake,
    testing::Values(
        Mistake{"0.1 -0.2 0.3", "0.1 nan 0.3", "twin.urdf: link post",
                "origin rpy is '0.1 nan 0.3', not 3 finite numbers"},
        Mistake{"0.4 0.6 0.1\"/></geometry></collision>", "0.4 0.6\"/></geometry></collision>",
                "twin.urdf: link base", "box size is '0.4 0.6', not 3"},
        Mistake{"0.4 0.6 0.1\"/></geometry></collision>", "0.4 -0.6 0.1\"/></geometry></collision>",
                "twin.urdf: link base", "box size is -0.6 m, it must be greater than 0"},
        Mistake{"radius=\"0.08\"", "radius=\"0\"", "twin.urdf: link post",
                "cylinder radius is 0 m"},
        Mistake{"length=\"1\"", "length=\"1e999\"", "twin.urdf: link post",
                "cylinder length is '1e999', not a finite number"},
        Mistake{"length=\"1\"", "len=\"1\"", "twin.urdf: link post", "cylinder length is missing"},
        Mistake{"sphere radius=\"0.09\"", "sphere radius=\"0x10\"", "twin.urdf: link post",
                "sphere radius is '0x10'"},
        Mistake{"scale=\"0.5 0.5 2\"", "scale=\"0.5 0 2\"", "twin.urdf: link l2",
                "mesh scale holds a 0"},
        Mistake{"scale=\"0.5 0.5 2\"", "scale=\"0.5\"", "twin.urdf: link l2",
                "mesh scale is '0.5', not 3"},
        Mistake{"multiplier=\"2\"", "multiplier=\"two\"", "twin.urdf: joint l_grip_mirror",
                "mimic multiplier is 'two'"},
        Mistake{"offset=\"0.001\"", "offset=\"inf\"", "twin.urdf: joint l_grip_mirror",
                "mimic offset is 'inf'"},
        Mistake{"xyz=\"0 0.6 0.8\"", "xyz=\"0 0 0\"", "twin.urdf: joint l_slide",
                "axis xyz '0 0 0' has no direction"},
        Mistake{"xyz=\"0 0.6 0.8\"", "xyz=\"0 1\"", "twin.urdf: joint l_slide",
                "axis xyz is '0 1'"},
        Mistake{"<axis xyz=\"0 0.6 0.8\"/>", "<axis/>", "twin.urdf: joint l_slide",
                "axis xyz is missing"},
        Mistake{"<axis xyz=\"0 0.6 0.8\"/>", "<axis xyz=\"0 0.6 0.8\"/><axis xyz=\"1 0 0\"/>",
                "twin.urdf: joint l_slide", "more than one <axis>"}));

INSTANTIATE_TEST_SUITE_P(
    Shapes, UrdfMistake,
    testing::Values(Mistake{"<sphere radius=\"0.09\"/>", "<capsule radius=\"0.09\" length=\"1\"/>",
                            "twin.urdf: link post",
                            "collision geometry <capsule> is not supported"},
                    Mistake{"<sphere radius=\"0.09\"/>", "", "twin.urdf: link post",
                            "collision geometry is empty"},
                    Mistake{"<sphere radius=\"0.09\"/>",
                            "<sphere radius=\"0.09\"/><sphere radius=\"1\"/>",
                            "twin.urdf: link post", "more than one shape"},
                    Mistake{"<geometry><sphere radius=\"0.09\"/></geometry>", "",
                            "twin.urdf: link post", "<geometry> is missing"},
                    Mistake{"package://shapes/tetra.stl", "package://shapes/../two_arms.urdf",
                            "twin.urdf: link l2", "leaves its folder"},
                    Mistake{"package://shapes/tetra.stl", "package://others/tetra.stl",
                            "twin.urdf: link l2", "package 'others'"},
                    Mistake{"package://shapes/tetra.stl", "package://shapes/octa.stl",
                            "twin.urdf: link l2", "does not exist"},
                    Mistake{"filename=\"package://shapes/tetra.stl\"", "", "twin.urdf: link l2",
                            "mesh filename is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Joints, UrdfMistake,
    testing::Values(Mistake{"effort=\"50\" velocity=\"2\"", "effort=\"50\"", "/robots/0/arms/0",
                            "gives no limit of velocity of l_turn; add to the arm \"limits\": "
                            "{\"l_turn\": {\"velocity_rad_s\": 1}}"},
                    Mistake{"velocity=\"2\"", "velocity=\"0\"", "/robots/0/arms/0",
                            "add to the arm \"limits\": {\"l_turn\": {\"velocity_rad_s\": 1}}"},
                    Mistake{"<limit effort=\"50\" velocity=\"3\"/>", "", "/robots/0/arms/1",
                            "add to the arm \"limits\": {\"r_spin\": {\"velocity_rad_s\": 1}}"},
                    Mistake{"lower=\"-1\" upper=\"1\"", "", "/robots/0/arms/1",
                            "gives no limit of position of r_last; add to the arm \"limits\": "
                            "{\"r_last\": {\"lower_rad\": -1, \"upper_rad\": 1}}"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"floating\"",
                            "two_arms.srdf: group right_arm",
                            "joint r_spin is floating or planar, which an arm cannot contain", 6},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"planar\"",
                            "two_arms.srdf: group right_arm", "joint r_spin is floating or planar",
                            6},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"hinge\"",
                            "twin.urdf: joint r_spin", "joint type 'hinge' is not known"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\"",
                            "twin.urdf: joint r_spin", "joint type is missing"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_gripp\"",
                            "twin.urdf: joint l_grip_mirror",
                            "mimic joint l_gripp does not exist; did you mean l_grip?", 40},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_grip_mirror\"",
                            "twin.urdf: joint l_grip_mirror", "the joint mimics itself", 40},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_wrist\"",
                            "twin.urdf: joint l_grip_mirror", "mimic joint l_wrist is fixed", 40},
                    Mistake{"mimic joint=\"l_grip\"", "mimic", "twin.urdf: joint l_grip_mirror",
                            "mimic joint is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Tree, UrdfMistake,
    testing::Values(
        Mistake{"<link name=\"r2\"/>", "<link name=\"r2\"/><link name=\"r2\"/>",
                "twin.urdf: link r2", "more than one link has this name"},
        Mistake{"\"r_last\" type", "\"r_bend\" type", "twin.urdf: joint r_bend",
                "more than one joint has this name"},
        Mistake{"<link name=\"r2\"/>", "<link/><link name=\"r2\"/>", "twin.urdf: link",
                "link name is missing"},
        Mistake{"<child link=\"r_tip\"/>", "<child link=\"r_top\"/>", "twin.urdf: joint r_last",
                "child link r_top does not exist; did you mean r_tip?", 63},
        Mistake{"<child link=\"r_tip\"/>", "", "twin.urdf: joint r_last", "<child> is missing", 63},
        Mistake{"<joint name=\"l_grip_mirror\"", "<joint", "twin.urdf: joint",
                "joint name is missing"},
        Mistake{"<parent link=\"post\"/><child link=\"r1\"/>",
                "<parent link=\"pots\"/><child link=\"r1\"/>", "twin.urdf: joint r_spin",
                "parent link pots does not exist", 50},
        Mistake{"<child link=\"r_tip\"/>", "<child link=\"r2\"/>", "twin.urdf: joint r_last",
                "child link r2 already has the parent joint r_bend", 63},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><link name=\"stray\"/>",
                "twin.urdf: robot",
                "more than one root link: base (line 7), stray (line 46); attach all but one to a "
                "<joint>"},
        Mistake{"<parent link=\"post\"/><child link=\"r1\"/>",
                "<parent link=\"r_tip\"/><child link=\"r1\"/>", "twin.urdf: robot",
                "links form a cycle without a root: r1 (line 46), r2 (line 47), r3 (line 48), "
                "r_tip (line 49)"},
        Mistake{"<robot name=\"two_arms\"", "<robot", "twin.urdf: robot",
                "robot name is missing"}));

// A misspelled element would lose a shape or a mimic silently.
INSTANTIATE_TEST_SUITE_P(
    Spelling, UrdfMistake,
    testing::Values(
        Mistake{"<link name=\"r1\"/>",
                "<link name=\"r1\"><colision><geometry><sphere radius=\"0.1\"/></geometry>"
                "</colision></link>",
                "twin.urdf: link r1", "<colision> is not known; did you mean <collision>?"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"><Collision/></link>",
                "twin.urdf: link r1", "<Collision> is not known; did you mean <collision>?"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"><COLLISIONS/></link>",
                "twin.urdf: link r1", "<COLLISIONS> is not known; did you mean <collision>?"},
        Mistake{"<collision><origin xyz=\"0 0 0.5\"", "<collision><orgin xyz=\"0 0 0.5\"",
                "twin.urdf: link post", "<orgin> is not known; did you mean <origin>?"},
        Mistake{"<origin xyz=\"0 0 0.5\"", "<origin xzy=\"0 0 0.5\"", "twin.urdf: link post",
                "origin attribute xzy is not known; did you mean origin attribute xyz?"},
        Mistake{"scale=\"0.5 0.5 2\"", "scal=\"0.5 0.5 2\"", "twin.urdf: link l2",
                "mesh attribute scal is not known; did you mean mesh attribute scale?"},
        Mistake{"<mimic joint=\"l_grip\"", "<mimick joint=\"l_grip\"",
                "twin.urdf: joint l_grip_mirror", "<mimick> is not known; did you mean <mimic>?"},
        Mistake{"multiplier=\"2\"", "multiplyer=\"2\"", "twin.urdf: joint l_grip_mirror",
                "did you mean mimic attribute multiplier?"},
        Mistake{"<axis xyz=\"0 0.6 0.8\"", "<axes xyz=\"0 0.6 0.8\"", "twin.urdf: joint l_slide",
                "<axes> is not known; did you mean <axis>?"},
        Mistake{"<limit lower=\"-1\" upper=\"1\" effort=\"50\" velocity=\"1.5\"/>",
                "<limit lower=\"-1\" upper=\"1\" effort=\"50\" velocity=\"1.5\"/><limits/>",
                "twin.urdf: joint r_last", "<limits> is not known; did you mean <limit>?"},
        Mistake{"<origin xyz=\"0 0 0.3\" rpy=\"0 0 -0.785\"/>",
                "<origin xyz=\"0 0 0.3\" quat_xyzw=\"0 0 0 1\"/>", "twin.urdf: joint l_wrist",
                "origin quat_xyzw is not read here; give the rotation as rpy"},
        Mistake{"<link name=\"r1\"/>",
                "<link name=\"r1\"/><model><link name=\"shelf\"><collision/></link></model>",
                "twin.urdf: robot", "<model> holds a part of the robot, which would be left out"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><collision/>", "twin.urdf: robot",
                "<collision> holds a part of the robot, which would be left out"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><Link name=\"table\"/>",
                "twin.urdf: robot", "<Link> is not known; did you mean <link>?"}));

TEST(UrdfElements, OfOtherToolsCauseNoWarning) {
  const ScratchFolder folder;
  const std::string others =
      "<gazebo reference='r1'><kp>1</kp></gazebo><transmission name='t'><joint name='r_spin'/>"
      "</transmission><ros2_control name='c'><joint name='r_spin'/></ros2_control>"
      "<drake:collision_filter_group name='g'/><sensor name='s'/>";
  const std::string link = "<link name=\"r1\"><drake:colision/><sensor/><contact/></link>";
  EXPECT_EQ(warnings_of(cell_with_urdf(folder, file_with(data_file("two_arms.urdf"),
                                                         "<link name=\"r1\"/>", link + others))),
            "");
}

INSTANTIATE_TEST_SUITE_P(
    Document, UrdfMistake,
    testing::Values(
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot>", "twin.urdf:1",
                "DOCTYPE or entity declaration is not allowed"},
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot [<!ENTITY a \"b\">]>", "twin.urdf:1",
                "DOCTYPE"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><xacro:property name=\"x\"/>",
                "twin.urdf:46", "the file is xacro"},
        Mistake{"</robot>", "", "twin.urdf:5", "the XML is malformed", 5},
        Mistake{"</robot>", "</robot><robot/>", "twin.urdf:67", "more than one XML element"}));

class UrdfOddity : public testing::TestWithParam<Mistake> {};

TEST_P(UrdfOddity, IsOnlyAWarning) {
  const Mistake& oddity = GetParam();
  const ScratchFolder folder;
  EXPECT_THAT(
      without_lines(warnings_of(
          cell_with_urdf(folder, file_with(data_file("two_arms.urdf"), oddity.from, oddity.to)))),
      testing::AllOf(HasSubstr(std::string(oddity.place) + " | "), HasSubstr(oddity.sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    All, UrdfOddity,
    testing::Values(
        Mistake{
            "size=\"0.4 0.6 0.1\"/></geometry><material",
            "size=\"0.4 0x10 0.1\"/></geometry><material", "twin.urdf: link base",
            "box size is '0.4 0x10 0.1', not 3 finite numbers; it is only displayed, not checked"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"><vizual/></link>", "twin.urdf: link r1",
                "<vizual> is not known here and is left out; did you mean <visual>?"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><world_frame/>", "twin.urdf: robot",
                "<world_frame> is not known here and is left out"},
        Mistake{"<origin xyz=\"0 0 0.3\" rpy=\"0 0 -0.785\"/>",
                "<origin xyz=\"0 0 0.3\" frame=\"world\"/>", "twin.urdf: joint l_wrist",
                "origin attribute frame is not known here and is left out"},
        Mistake{"rpy=\"0 0 -0.785\"", "rpy=\"0 0 -45\"", "twin.urdf: joint l_wrist",
                "origin rpy holds -45, more than a full turn: angles are in rad (degrees?)"},
        Mistake{"<link name=\"r1\"/>",
                "<link name=\"r1\"><visual><geometry><sphere radius=\"1\"/></geometry></visual>"
                "</link>",
                "twin.urdf: links",
                "r1 have a <visual> but no <collision>: the dashboard shows them, but they are not "
                "checked, so collisions with them are not detected"},
        Mistake{"<link name=\"r3\"><collision><geometry><sphere radius=\"0.03\"/></geometry>"
                "</collision></link>",
                "<link name=\"r3\"/>", "twin.urdf: arm right",
                "no link has <collision> geometry, so its motions are not checked and it may hit "
                "anything"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"><gravity>0</gravity></link>",
                "twin.urdf: link r1", "<gravity> is not known here and is left out"},
        Mistake{"<link name=\"r1\"/>",
                "<link name=\"r1\"><inertial><mass value=\"heavy\"/></inertial></link>",
                "twin.urdf: link r1", "mass value is 'heavy'"},
        Mistake{"effort=\"50\" velocity=\"2\"", "effort=\"much\" velocity=\"2\"",
                "twin.urdf: joint l_turn",
                "effort is 'much', not a finite number; efforts play no"},
        Mistake{"lower=\"-1\" upper=\"1\"", "upper=\"1\"", "twin.urdf: joint r_last",
                "limit lower is missing; 0 is used, as the URDF specification says"},
        Mistake{"velocity=\"0.2\"", "velocity=\"0\"", "twin.urdf: joint l_grip",
                "no velocity limit; assuming 1 m/s for this gripper joint. To set it, add to arm "
                "left \"limits\": {\"l_grip\": {\"velocity_m_s\": 1}}"},
        Mistake{
            "xyz=\"0.1 0.05 0\"", "xyz=\"0.1 333 0\"", "twin.urdf: joint l_turn",
            "m, probably a unit error (millimeters?); its links are checked at that distance"}));

}  // namespace
}  // namespace armloom
