#include "core/model/xml/xacro.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

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

TEST_F(Xacro, GetsTheFileAsOneArgumentAndReturnsItsOutput) {
  install("cat \"$1\"; test $# = 1");
  EXPECT_EQ(expand_xacro(file_)->text, "<robot/>");
  EXPECT_EQ(expand_xacro(file_)->said, "");
}

// xacro prints the error first and its place last.
TEST_F(Xacro, FailureIsReportedInFull) {
  install(
      "echo 'error: undefined macro: arm' >&2; echo \"when processing file: a.xacro\" >&2; exit 2");
  EXPECT_EQ(expand_xacro(file_).error(),
            "xacro says: error: undefined macro: arm; when processing file: a.xacro");
  install(
      "echo 'XML parsing error: no element found: line 2' >&2; echo >&2; echo 'Check that:' >&2; "
      "echo ' - Your XML is well-formed' >&2; exit 2");
  EXPECT_EQ(expand_xacro(file_).error(),
            "xacro says: XML parsing error: no element found: line 2; Check that:; - Your XML is "
            "well-formed");
  install("exit 3");
  EXPECT_EQ(expand_xacro(file_).error(), "xacro failed without a message");
}

TEST_F(Xacro, PythonExceptionIsReportedByItsLastLine) {
  install(
      "echo 'Traceback (most recent call last):' >&2; echo '  File \"x\", line 1' >&2; "
      "echo \"ModuleNotFoundError: No module named 'xacro'\" >&2; exit 1");
  EXPECT_EQ(expand_xacro(file_).error(),
            "xacro says: ModuleNotFoundError: No module named 'xacro'");
}

TEST_F(Xacro, LongErrorOutputIsTruncated) {
  install("seq -s e 5000 | tr -d 0-9 >&2; exit 2");
  EXPECT_EQ(expand_xacro(file_).error(), "xacro says: " + std::string(1000, 'e') + "...");
}

TEST_F(Xacro, IsKilledAtItsTimeAndOutputLimits) {
  install("exec sleep 60");
  EXPECT_EQ(expand_xacro(file_, 1s).error(), "xacro took more than 1 s");
  install("exec yes '<link/>'");
  EXPECT_THAT(expand_xacro(file_).error(), HasSubstr("xacro printed more than 16777216 bytes"));
}

TEST_F(Xacro, MissingProgramIsReportedWithRemedy) {
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

// An include that matches no file silently drops its content.
TEST_F(Xacro, WarningsArePassedOn) {
  install("cat \"$1\"; echo 'warning: matched no files.' >&2");
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = folder_.write(
      "twin.urdf.xacro", file_with(data_file("two_arms.urdf"), "lower=\"-2\"", "lower=\"-1\""));
  EXPECT_THAT(warnings_of(cell),
              HasSubstr("twin.urdf.xacro: xacro says: warning: matched no files."));
}

}  // namespace
}  // namespace armloom
