#include "core/model/xacro.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

// A program `xacro` of our own, first on the PATH.
class Xacro : public testing::Test {
 protected:
  ~Xacro() override { setenv("PATH", path_.c_str(), 1); }

  void install(const std::string& script) {
    const std::string program = folder_.write("bin/xacro", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("PATH", (folder_.path() / "bin").string().append(":").append(path_).c_str(), 1);
  }

  const ScratchFolder folder_;
  const std::string path_ = getenv("PATH");
  const std::string file_ = folder_.write("a robot; exit.urdf.xacro", "<robot/>");
};

TEST_F(Xacro, GetsTheFileAsOneArgumentAndGivesWhatItPrints) {
  install("cat \"$1\"; test $# = 1");
  EXPECT_EQ(expand_xacro(file_), "<robot/>");
}

TEST_F(Xacro, SaysItsLastLineWhenItFails) {
  install("echo Traceback >&2; echo 'undefined macro: arm' >&2; exit 2");
  EXPECT_EQ(expand_xacro(file_).error(), "xacro says: undefined macro: arm");
}

TEST_F(Xacro, IsEndedAtItsTimeAndItsLength) {
  install("exec sleep 60");
  EXPECT_EQ(expand_xacro(file_, 1s).error(), "xacro took more than 1 s");
  install("exec yes '<link/>'");
  EXPECT_THAT(expand_xacro(file_).error(), HasSubstr("xacro printed more than 16777216 bytes"));
}

TEST_F(Xacro, ThatIsNotInstalledIsToldWithWhatToDo) {
  std::filesystem::create_directory(folder_.path() / "empty");
  setenv("PATH", (folder_.path() / "empty").c_str(), 1);
  EXPECT_THAT(
      expand_xacro(file_).error(),
      testing::AllOf(HasSubstr("the program xacro is not installed"),
                     HasSubstr("(xacro " + file_ + " > "), HasSubstr("a robot; exit.urdf)")));
}

TEST_F(Xacro, ExpandsTheFilesOfARobot) {
  install("sed s/@lower@/-2/ \"$1\"");
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf =
      folder_.write("twin.urdf.xacro",
                    file_with(data_file("two_arms.urdf"), "lower=\"-2\"", "lower=\"@lower@\""));
  EXPECT_EQ(build_or_fail(cell)->joint(JointId(1)).lower, -2.0);
}

}  // namespace
}  // namespace armloom
