#include "server/import/import_cell.h"

#include <algorithm>
#include <set>

#include "core/base/diagnostics.h"
#include "core/model/cell/build_cell.h"
#include "server/codec/cell_format.h"
#include "server/codec/cell_schema.h"
#include "server/codec/commented_json.h"
#include "server/import/homes.h"
#include "server/import/imported_robot.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Problems> refused(std::string option, std::string why) {
  return failure(
      Problem{ProblemKind::invalid, "bad-option", std::move(option), std::move(why), {}});
}

class CellImport {
 public:
  explicit CellImport(const ImportRequest& request) : request_(request) {}

  Result<ImportedCell> run() {
    Problems problems;
    for (const RobotFiles& files : request_.files) {
      auto robot = read_imported_robot(files, request_.packages);
      if (robot) {
        sources_.push_back(*std::move(robot));
      } else {
        problems.insert(problems.end(), robot.error().begin(), robot.error().end());
      }
    }
    if (!problems.empty()) return failure(std::move(problems));
    if (auto placed = place(); !placed) return failure(std::move(placed.error()));
    for (std::size_t r = 0; r < placements_.size(); ++r) add_robot(r);
    remark_on_unused_packages();
    name_cell();
    set_homes();
    return ImportedCell{written(), std::move(remarks_)};
  }

 private:
  Result<bool> place() {
    placements_ = request_.robots;
    if (placements_.empty()) {
      for (const ImportedRobot& source : sources_) placements_.push_back({source.name, {}});
    }
    if (sources_.size() > 1 && sources_.size() != placements_.size()) {
      return refused("--urdf", std::to_string(sources_.size()) + " --urdf but " +
                                   std::to_string(placements_.size()) +
                                   " --robot: give one URDF for all robots, or one for each");
    }
    if (placements_.size() > 1 && !request_.prefix.empty()) {
      return refused("--prefix",
                     "several robots use their names as prefixes, omit this option: \"" +
                         placements_.front().name + "_\"");
    }
    return true;
  }

  const ImportedRobot& source_of(std::size_t robot) const {
    return sources_.size() == 1 ? sources_.front() : sources_[robot];
  }

  // Adds a sentence about the place `pointer` in the cell file. It appears in the file's comments
  // and on stderr.
  void remark(const std::string& pointer, const std::string& sentence) {
    notes_[pointer].push_back(sentence);
    remarks_.push_back(pointer + ": " + sentence);
  }

  void add_robot(std::size_t r) {
    const ImportedRobot& source = source_of(r);
    const Placement& placement = placements_[r];
    const bool alone = placements_.size() == 1;
    RobotDescription robot;
    robot.name = placement.name;
    robot.urdf = source.files.urdf.string();
    robot.srdf = source.files.srdf.string();
    robot.joint_limits = source.files.joint_limits.string();
    robot.srdf_prefix = source.files.srdf_prefix;
    robot.joint_limits_prefix = source.files.joint_limits_prefix;
    robot.prefix = alone ? request_.prefix : placement.name + "_";
    robot.X_WB = pose_of_words(placement.base);
    robot.packages = source.packages.folders;
    for (const HeldJoint& joint : source.held) robot.fixed[joint.name] = joint.value;
    for (std::size_t a = 0; a < source.arms.size(); ++a) {
      const std::string& group = source.arms[a];
      ArmDescription& arm = robot.arms.emplace_back();
      arm.limits = source.guesses[a];
      arm.group = group;
      arm.name = source.arms.size() == 1 ? placement.name
                 : alone                 ? group
                                         : placement.name + "_" + group;
    }
    cell_.robots.push_back(std::move(robot));
    // Remarks on shared files are added once.
    if (r == 0 || sources_.size() > 1) remark_on(source, "/robots/" + std::to_string(r));
  }

  void remark_on(const ImportedRobot& source, const std::string& pointer) {
    for (const auto& [package, missing] : source.packages.missing) {
      remark(pointer + "/packages",
             "Not shown in the dashboard: " +
                 to_text(package, missing, source.files.urdf, source.packages.unused) + ".");
    }
    for (const auto& [package, folder] : source.packages.guessed) {
      remark(pointer + "/packages", "The folder of the package " + package +
                                        " is a guess: " + folder +
                                        " contains a file of the package, but has another name.");
    }
    for (const HeldJoint& joint : source.held) {
      remark(pointer + "/fixed",
             joint.name + " moves arms and belongs to no single arm: fixed " +
                 (joint.state.empty() ? "at zero, or at the nearest limit."
                                      : "at its value in the state " + joint.state + "."));
    }
    std::string left_out;
    for (const GroupChoice& group : source.left_out) {
      left_out += left_out.empty() ? "" : "; ";
      left_out += group.group + ", because " + group.why;
    }
    if (!left_out.empty())
      remark(pointer + "/arms", "Groups of the SRDF that are not used as arms: " + left_out + ".");
    remark_on_guesses(source, pointer);
  }

  void remark_on_unused_packages() {
    for (const auto& [name, folder] : request_.packages) {
      if (std::ranges::any_of(sources_, [&, &package = name](const ImportedRobot& source) {
            return !source.packages.unused.contains(package);
          }))
        continue;
      remark("/robots", "No mesh is in a package " + name + ": --package " + name + "=" + folder +
                            " was not needed.");
    }
  }

  void remark_on_guesses(const ImportedRobot& source, const std::string& pointer) {
    for (std::size_t a = 0; a < source.guesses.size(); ++a) {
      std::string joints;
      for (const auto& [joint, guess] : source.guesses[a]) {
        joints += (joints.empty() ? "" : ", ") + joint;
      }
      if (joints.empty()) continue;
      remark(pointer + "/arms/" + std::to_string(a) + "/limits",
             source.files.urdf.filename().string() + " does not give all limits of " + joints +
                 ": these are cautious guesses. Replace them with the robot's real limits.");
    }
  }

  void name_cell() {
    cell_.name = request_.cell;
    std::set<std::string> told;
    for (const ImportedRobot& source : sources_) {
      if (!request_.cell.empty() || !told.insert(source.name).second) continue;
      cell_.name += (cell_.name.empty() ? "" : "_and_") + source.name;
    }
    if (request_.cell.empty() && cell_.robots.size() > sources_.size()) {
      cell_.name = std::to_string(cell_.robots.size()) + "_" + cell_.name;
    }
  }

  // Sets no homes if the cell cannot be built. Loading the cell will report why.
  void set_homes() {
    Problems warnings;
    const auto cell = build_cell(cell_, warnings);
    if (!cell) return;
    if (std::ranges::any_of(warnings, [](const Problem& one) { return one.slug == "huge-mesh"; })) {
      return remark("/robots",
                    "No homes were chosen, because meshes are so large that their unit is probably "
                    "wrong: first correct their scale in the URDF.");
    }
    const auto homes = choose_homes(*cell);
    if (!homes) return;
    std::size_t next = 0;
    for (std::size_t r = 0; r < cell_.robots.size(); ++r) {
      for (std::size_t a = 0; a < cell_.robots[r].arms.size(); ++a, ++next) {
        const std::string pointer =
            "/robots/" + std::to_string(r) + "/arms/" + std::to_string(a) + "/home";
        set_home(**cell, cell_.robots[r].arms[a], homes->of_arm[next], homes->wanted[next],
                 homes->is_free ? homes->found.at_first[next] : std::nullopt, pointer);
      }
    }
    remark_on_lasting(*homes);
    if (!homes->is_free) remark_on_no_homes(**cell, *homes);
  }

  // Adds remarks about bodies of one robot that are too close wherever its arm is.
  void remark_on_lasting(const Homes& homes) {
    std::string own;
    std::string others;
    std::set<std::string> elements;
    std::set<std::string> pairs;
    bool apart = true;
    for (const HomeObstacle& obstacle : homes.found.lasting) {
      std::string& list = obstacle.is_self ? own : others;
      list += (list.empty() ? "" : ", ") + obstacle.body_a + " and " + obstacle.body_b;
      if (obstacle.is_self) {
        elements.insert(obstacle.srdf_element);
        apart = apart && obstacle.clearance_m >= 1e-4;
      } else {
        pairs.insert("[\"" + obstacle.body_a + "\", \"" + obstacle.body_b + "\"]");
      }
    }
    const std::string no_help =
        " at all positions that were tried, so neither other homes nor other bases help: ";
    if (!own.empty()) {
      remark("/self_clearance_m", "Links of one arm are closer than self_clearance_m" + no_help +
                                      own + ". If they are so close by design, add to the SRDF " +
                                      joined(elements, " ") +
                                      (apart ? ", or lower self_clearance_m." : "."));
    }
    if (!others.empty()) {
      remark("/allowed_collisions",
             "Links of an arm are closer than their clearance to the body that carries it" +
                 no_help + others + ". If they may touch, add " + joined(pairs, ", ") + " here.");
    }
  }

  static std::string joined(const std::set<std::string>& texts, const std::string& between) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
    return all;
  }

  static std::string limit_of(const HomeObstacle& obstacle) {
    return (obstacle.is_self ? "self_clearance_m (" : "their clearance (") +
           text_of(obstacle.limit_m) + " m)";
  }

  // Returns true if moving bases changes the distance of the two.
  bool bases_matter(const Cell& cell, const HomeObstacle& obstacle) const {
    if (obstacle.is_self) return false;
    return !obstacle.other || cell.arm(obstacle.arm).robot != cell.arm(*obstacle.other).robot;
  }

  void remark_on_no_homes(const Cell& cell, const Homes& homes) {
    std::string text = "No homes were found at which all arms keep their clearances";
    bool move_bases = false;
    for (const HomeObstacle& obstacle : homes.found.frequent) {
      const std::size_t tried = homes.tried[obstacle.arm.index()];
      text += "; " + obstacle.body_a + " and " + obstacle.body_b + " are closer than " +
              limit_of(obstacle) + " at " + std::to_string(obstacle.places) + " of " +
              std::to_string(tried) + " positions of arm " + cell.arm(obstacle.arm).name;
      move_bases = move_bases || bases_matter(cell, obstacle);
    }
    remark("/robots", text + (move_bases ? ": move the bases apart, or set homes yourself."
                                         : ": set homes yourself."));
  }

  void set_home(const Cell& cell, ArmDescription& arm, const HomeCandidate& home,
                const HomeCandidate& wanted, const std::optional<HomeObstacle>& obstacle,
                const std::string& pointer) {
    using Kind = HomeCandidate::Kind;
    if (home.kind == Kind::named) {
      arm.home_state = home.state;
    } else {
      arm.home.assign(home.q.begin(), home.q.end());
    }
    if (home.kind == wanted.kind && home.state == wanted.state) {
      if (home.kind == Kind::zero) {
        remark(pointer, "No state of the SRDF gives all joints of arm " + arm.name +
                            ", so every joint is at zero.");
      }
      return;
    }
    const std::string where =
        wanted.kind == Kind::named ? "In the state " + wanted.state : "With every joint at zero";
    const std::string not_free =
        where + " arm " + arm.name + " is too close to " +
        (obstacle ? (obstacle->is_self ? "itself" : "other bodies") + (" (" + obstacle->body_a) +
                        " and " + obstacle->body_b + ")"
                  : "other arms or objects here");
    if (home.kind == Kind::made_up) {
      const bool move_bases = !obstacle || bases_matter(cell, *obstacle);
      remark(pointer, not_free +
                          ", and other states of the SRDF do not help: this home was generated. "
                          "Check it before you use it, or " +
                          (move_bases ? "move the bases apart." : "set another."));
    } else if (home.kind == Kind::zero) {
      remark(pointer, not_free + ": every joint is at zero instead.");
    } else {
      remark(pointer, not_free + ": " + home.state + " is used instead.");
    }
  }

  std::string written() {
    CellDescription cell = cell_;
    for (RobotDescription& robot : cell.robots) {
      for (std::string* path : {&robot.urdf, &robot.srdf, &robot.joint_limits}) shorten(*path);
      for (auto& [name, folder] : robot.packages) shorten(folder);
    }
    std::set<std::string> names;
    for (const ImportedRobot& source : sources_) {
      names.insert(source.files.urdf.filename().string());
      names.insert(source.files.srdf.filename().string());
    }
    std::string from;
    for (const std::string& name : names) from += (from.empty() ? "" : ", ") + name;
    notes_[""] = {
        "Written by armloom import from " + from +
        ". Positions are in meters, angles in radians, times in seconds; every setting has "
        "its default."};
    JsonWriter out;
    cell_format().write(out, cell);
    return commented_json(Schema::parse(out.text()), cell_schema(), notes_);
  }

  void shorten(std::string& path) const {
    if (path.empty()) return;
    const fs::path absolute = fs::weakly_canonical(path);
    path = request_.folder
               ? absolute.lexically_proximate(fs::weakly_canonical(*request_.folder)).string()
               : absolute.string();
  }

  const ImportRequest& request_;
  std::vector<ImportedRobot> sources_;
  std::vector<Placement> placements_;
  CellDescription cell_;
  JsonNotes notes_;
  std::vector<std::string> remarks_;
};

}  // namespace

Result<ImportedCell> import_cell(const ImportRequest& request) { return CellImport(request).run(); }

}  // namespace armloom
