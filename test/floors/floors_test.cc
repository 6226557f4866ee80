// Checks the includes of core and server: a folder includes only from the folders below it. Checks
// that the scheduler's state is written only by its owners.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "test/source_dir.h"

namespace {

namespace fs = std::filesystem;

// Folders, or single files, that a folder may include besides itself.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core/base", {}},
    {"core/geometry", {"core/base"}},
    {"core/model", {"core/base", "core/geometry"}},
    {"core/trajectory", {"core/base", "core/model"}},
    {"core/coordination", {"core/base", "core/model", "core/trajectory"}},
    {"core/collision",
     {"core/base", "core/geometry", "core/model", "core/trajectory", "core/coordination"}},
    {"core/planning",
     {"core/base", "core/geometry", "core/model", "core/trajectory", "core/coordination",
      "core/collision"}},
    {"core/precedence", {"core/base", "core/model", "core/trajectory", "core/coordination"}},
    {"core/sequence", {"core/base"}},
    {"core/deadlock", {"core/base"}},
    {"core/jobs",
     {"core/base", "core/model", "core/trajectory", "core/coordination", "core/precedence",
      "core/sequence"}},
    {"core/policies",
     {"core/base", "core/model", "core/trajectory", "core/coordination", "core/precedence"}},
    {"core/scheduler",
     {"core/base", "core/model", "core/trajectory", "core/coordination", "core/precedence",
      "core/sequence", "core/deadlock", "core/jobs", "core/policies"}},
    {"core/monitor", {"core/base", "core/model", "core/trajectory", "core/coordination"}},
    {"core/guard", {"core/base", "core/model", "core/trajectory", "core/coordination"}},
    {"core/arm", {"core/base", "core/model", "core/trajectory", "core/coordination"}},
    // The audit shares only the model and the mesh loader with admission.
    {"core/audit",
     {"core/base", "core/model", "core/geometry/shape.h", "core/geometry/mesh/mesh.h",
      "core/geometry/mesh/surface_tree.h"}},
    {"core/executive",
     {"core/base", "core/geometry", "core/model", "core/trajectory", "core/coordination",
      "core/collision", "core/planning", "core/precedence", "core/sequence", "core/jobs",
      "core/policies/policy_names.h", "core/scheduler", "core/monitor", "core/guard", "core/arm"}},
    {"server",
     {"core/base", "core/geometry", "core/model", "core/trajectory", "core/coordination",
      "core/planning", "core/arm", "core/executive", "core/audit"}},
};

// Modules of a folder, lowest first: each includes only from itself and lower modules.
const std::map<std::string, std::vector<std::string>> kRooms = {
    {"core/geometry", {"mesh", "capsule", "surface", "convex"}},
    {"core/model", {"xml", "urdf", "srdf", "cell"}},
    {"core/collision", {"scene", "filter", "state", "diagram", "check"}},
    {"server", {"access",      "store",   "codec",    "metrics", "log",       "physics", "drivers",
                "arm_process", "http",    "messages", "control", "recording", "import",  "replay",
                "comparison",  "durable", "hub",      "api",     "service",   "command"}},
};

const std::map<std::string, std::vector<std::string>> kMustNotSay = {
    {"core", {"nlohmann", "boost/asio", "boost/beast", "spdlog", "std::cout", "std::cerr"}},
    {"core/precedence",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/sequence",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/deadlock",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/policies",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/jobs", {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/scheduler",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/monitor",
     {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/guard", {"::now()", "<thread>", "<mutex>", "<atomic>", "<condition_variable>", "asio"}},
    {"core/base", {"::now()"}},
};

// Returns "core/model" for core/model/x/y.h and "server" for server/x/y.h.
std::string room_of(const std::string& path) {
  const auto first = path.find('/');
  if (path.substr(0, first) == "server") return "server";
  return path.substr(0, path.find('/', first + 1));
}

// Returns the height of a file's module in its folder; 0 if it is in no module.
std::size_t height_in_folder(const std::string& path) {
  const auto rooms = kRooms.find(room_of(path));
  if (rooms == kRooms.end()) return 0;
  for (std::size_t i = 0; i < rooms->second.size(); ++i) {
    if (path.starts_with(rooms->first + "/" + rooms->second[i] + "/")) return i + 1;
  }
  return 0;
}

// The folders that see the scheduler's state, or what it consists of.
const std::set<std::string> kSeeState = {"core/jobs",       "core/scheduler", "core/executive",
                                         "core/precedence", "core/sequence",  "core/deadlock",
                                         "core/policies"};
// The only files there that may change a State, Step or Job, or raise a version of the scheduler.
// The last ones own a state of their own: the places of arms in a sequence, and the live scene.
const std::set<std::string> kOwners = {"core/jobs/arm_rests.cc",
                                       "core/jobs/arm_rests.h",
                                       "core/jobs/job_book.cc",
                                       "core/jobs/job_book.h",
                                       "core/jobs/state.cc",
                                       "core/jobs/step_facts.cc",
                                       "core/jobs/step_facts.h",
                                       "core/sequence/safe_sequence.cc",
                                       "core/sequence/safe_sequence.h",
                                       "core/executive/live_scene.cc"};

std::vector<std::string> foreign_writes_in(const std::string& path, const std::string& text) {
  if (!kSeeState.contains(room_of(path)) || kOwners.contains(path)) return {};
  static const std::regex write(
      R"re((const\s+)?(\b(\w+::)*(State|Step|Job)\s*[&*]|\bconst_cast|\+\+[\w.>()-]*(version|changes)))re");
  std::vector<std::string> writes;
  for (std::sregex_iterator it(text.begin(), text.end(), write), end; it != end; ++it) {
    if (!(*it)[1].matched) writes.push_back(path + " is no owner of the state: " + (*it)[0].str());
  }
  return writes;
}

std::vector<std::string> breaches_in(const std::string& path, const std::string& text) {
  std::vector<std::string> breaches;
  const std::string room = room_of(path);
  const auto allowed = kMayInclude.find(room);
  if (allowed == kMayInclude.end()) return {path + ": " + room + " is no room of the design"};
  static const std::regex include(R"re(^\s*#\s*include\s+"((core|server)/[^"]+)")re",
                                  std::regex::multiline);
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
    const std::string target = room_of((*it)[1]);
    if (target != room && !allowed->second.contains(target) &&
        !allowed->second.contains((*it)[1])) {
      breaches.push_back(path + " includes " + (*it)[1].str());
    } else if (target == room && height_in_folder(path) < height_in_folder((*it)[1])) {
      breaches.push_back(path + " includes " + (*it)[1].str() + " of a room above it");
    }
  }
  if (!path.starts_with("server/store/") && text.find("sqlite3.h") != std::string::npos) {
    breaches.push_back(path + " knows SQL");
  }
  if (!path.starts_with("server/physics/") && text.find("mujoco/") != std::string::npos) {
    breaches.push_back(path + " knows MuJoCo");
  }
  for (const auto& [where, words] : kMustNotSay) {
    if (!path.starts_with(where + "/")) continue;
    for (const std::string& word : words) {
      if (text.find(word) != std::string::npos) breaches.push_back(path + " says " + word);
    }
  }
  return breaches;
}

// Calls `found_in(path, text)` for each source file, and reports what it returns.
void expect_none(const std::function<std::vector<std::string>(const std::string&,
                                                              const std::string&)>& found_in) {
  const fs::path root = armloom::source_dir();
  std::size_t files = 0;
  for (const char* top : {"core", "server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cc")) continue;
      std::ifstream in(entry.path());
      std::stringstream text;
      text << in.rdbuf();
      ++files;
      const std::string path = fs::relative(entry.path(), root).generic_string();
      for (const std::string& breach : found_in(path, text.str())) ADD_FAILURE() << breach;
    }
  }
  EXPECT_GT(files, 50u) << "the sources were not found";
}

TEST(Floors, EveryFileIncludesOnlyLowerLayers) { expect_none(breaches_in); }

TEST(Floors, OnlyItsOwnersWriteTheSchedulersState) { expect_none(foreign_writes_in); }

TEST(Floors, ForeignWritesAreDetected) {
  for (const char* write : {"void f(State& state);", "Step* step;", "void f(StepId id, Job& job);",
                            "++state.version;", "  ++changes_;", "const_cast<X&>(x);"}) {
    for (const std::string& folder : kSeeState) {
      EXPECT_FALSE(foreign_writes_in(folder + "/x.cc", write).empty()) << folder << ": " << write;
    }
    EXPECT_FALSE(foreign_writes_in("core/scheduler/ways/x.cc", write).empty()) << write;
    EXPECT_TRUE(foreign_writes_in("core/jobs/job_book.cc", write).empty()) << write;
  }
  for (const char* read : {"void f(const State& state);", "const Precedence::Step& step",
                           "std::vector<const Step*> steps;", "void f(Transitions& state);"}) {
    EXPECT_TRUE(foreign_writes_in("core/scheduler/ways/x.cc", read).empty()) << read;
  }
}

TEST(Floors, BreachesAreDetected) {
  EXPECT_FALSE(
      breaches_in("core/scheduler/x.cc", "#include \"core/collision/check/motion_checker.h\"\n")
          .empty());
  EXPECT_FALSE(
      breaches_in("core/scheduler/p/x.cc", "#include \"core/monitor/monitor.h\"\n").empty());
  EXPECT_FALSE(
      breaches_in("core/audit/x.cc", "#include \"core/collision/check/motion_checker.h\"\n")
          .empty());
  EXPECT_FALSE(
      breaches_in("core/audit/x.cc", "#include \"core/geometry/convex/convex_shape.h\"\n").empty());
  EXPECT_FALSE(breaches_in("core/geometry/x.cc", "#include \"core/model/cell.h\"\n").empty());
  EXPECT_FALSE(
      breaches_in("core/geometry/mesh/x.cc", "#include \"core/geometry/surface/solid.h\"\n")
          .empty());
  EXPECT_FALSE(
      breaches_in("core/model/urdf/x.cc", "#include \"core/model/cell/build_cell.h\"\n").empty());
  EXPECT_FALSE(breaches_in("server/x.cc", "#include \"core/jobs/job.h\"\n").empty());
  EXPECT_FALSE(breaches_in("server/http/x.cc", "#include \"server/messages/job.h\"\n").empty());
  EXPECT_FALSE(breaches_in("server/hub/x.cc", "#include \"server/api/route.h\"\n").empty());
  EXPECT_FALSE(breaches_in("server/x.cc", "#include \"server/log/log_line.h\"\n").empty());
  EXPECT_TRUE(breaches_in("server/api/x.cc", "#include \"server/http/router.h\"\n").empty());
  EXPECT_FALSE(breaches_in("core/monitor/x.cc", "auto t = Clock::now();\n").empty());
  EXPECT_FALSE(breaches_in("core/executive/x.cc", "#include <nlohmann/json.hpp>\n").empty());
  EXPECT_FALSE(breaches_in("core/misc/x.cc", "").empty());
  EXPECT_FALSE(breaches_in("server/api/x.cc", "#include <sqlite3.h>\n").empty());
  EXPECT_TRUE(breaches_in("server/store/x.cc", "#include <sqlite3.h>\n").empty());
  EXPECT_FALSE(breaches_in("server/api/x.cc", "#include <mujoco/mujoco.h>\n").empty());
  EXPECT_TRUE(breaches_in("server/physics/x.cc", "#include <mujoco/mujoco.h>\n").empty());
  EXPECT_TRUE(breaches_in("core/audit/x.cc", "#include \"core/geometry/mesh/mesh.h\"\n").empty());
  EXPECT_TRUE(
      breaches_in("core/geometry/convex/x.cc", "#include \"core/geometry/mesh/mesh.h\"\n").empty());
  EXPECT_TRUE(breaches_in("core/scheduler/x.cc", "#include \"core/jobs/job.h\"\n").empty());
  EXPECT_TRUE(breaches_in("core/executive/x.cc", "#include \"core/jobs/job.h\"\n").empty());
}

}  // namespace
