#include "server/physics/mjcf.h"

#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>
#include <variant>

#include "core/base/diagnostics.h"
#include "core/geometry/mesh/mesh.h"
#include "server/physics/link_inertia.h"
#include "server/physics/robot_dynamics.h"

namespace armloom {
namespace {

std::string row(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + text_of(number);
  return text;
}
std::string row(const Eigen::Vector3d& v) { return row({v.x(), v.y(), v.z()}); }

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return attribute("pos", row(X.translation())) +
         attribute("quat", row({q.w(), q.x(), q.y(), q.z()}));
}

std::string inertial(const LinkInertia& inertia) {
  // MuJoCo refuses thin rods and plates, and what rounding makes of them.
  const Eigen::Matrix3d I =
      inertia.I_C_kg_m2 + 1e-6 * inertia.I_C_kg_m2.trace() * Eigen::Matrix3d::Identity();
  return "<inertial" + attribute("pos", row(inertia.p_LC)) +
         attribute("mass", text_of(inertia.mass_kg)) +
         attribute("fullinertia", row({I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)})) +
         "/>\n";
}

LinkInertia sphere_inertia(double mass_kg, double radius_m, const Eigen::Vector3d& p_LC) {
  return {mass_kg, p_LC, 0.4 * mass_kg * radius_m * radius_m * Eigen::Matrix3d::Identity()};
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 3; ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > 3 ? text + ", ..." : text;
}

class Writer {
 public:
  Writer(const Cell& cell, const MjcfOptions& options, Problems& warnings)
      : cell_(cell), options_(options), warnings_(warnings) {}

  Result<Mjcf> write() {
    check_payload();
    children_.resize(cell_.links.size());
    std::vector<std::size_t> roots;
    for (std::size_t l = 0; l < cell_.links.size(); ++l) {
      const Link& link = cell_.links[l];
      if (options_.robot && link.robot != *options_.robot) continue;
      (link.parent ? children_[link.parent->index()] : roots).push_back(l);
    }
    for (std::size_t r = 0; r < cell_.robots.size(); ++r) {
      const RobotId robot{static_cast<std::uint32_t>(r)};
      if (options_.robot && robot != *options_.robot) continue;
      dynamics_ = read_dynamics(cell_.robots[r].urdf_text, cell_.robots[r].name, warnings_);
      for (const std::size_t root : roots) {
        if (cell_.links[root].robot == robot) write_link(root);
      }
      report_assumptions(cell_.robots[r]);
    }
    for (const CollisionObject& object : cell_.objects) write_object(object);
    if (!problems_.empty()) return failure(std::move(problems_));
    mjcf_.text = head() + "<asset>\n" + assets_ + "</asset>\n<worldbody>\n" + bodies_ +
                 "</worldbody>\n<contact>\n" + excluded_pairs() + "</contact>\n<equality>\n" +
                 locks() + "</equality>\n</mujoco>\n";
    return std::move(mjcf_);
  }

 private:
  void check_payload() {
    if (!options_.payload) return;
    const Payload& payload = *options_.payload;
    const auto link = cell_.find_link(payload.link);
    if (!link || (options_.robot && cell_.link(*link).robot != *options_.robot)) {
      problems_.push_back({ProblemKind::not_found, "unknown-link", "payload",
                           "no link '" + payload.link + "' in the robot", payload.link});
    }
    if (!(payload.mass_kg > 0.0) || !std::isfinite(payload.mass_kg)) {
      problems_.push_back({ProblemKind::invalid, "payload-mass", "payload",
                           "mass is " + text_of(payload.mass_kg) + " kg, not a positive number",
                           payload.mass_kg});
    }
  }

  [[nodiscard]] std::string head() const {
    // MuJoCo derives its stack (in numbers of 8 bytes) from njmax, too small if there are no rows.
    const std::string rows = options_.is_static ? "1\" nstack=\"1000000"
                                                : std::to_string(3 * options_.contacts_max + 200);
    return "<mujoco><compiler angle=\"radian\" usethread=\"false\"/>\n"
           "<size nconmax=\"" +
           std::to_string(options_.contacts_max) + "\" njmax=\"" + rows +
           "\"/>\n<option integrator=\"implicit\" cone=\"elliptic\" timestep=\"" +
           text_of(to_seconds(options_.time_step)) +
           "\" gravity=\"0 0 -9.81\"><flag filterparent=\"disable\" energy=\"enable\"/></option>\n"
           // Stiff contacts, brakes and friction; the first number is a time constant (s).
           "<default><geom solref=\"0.004 1\"/>\n"
           "<equality solref=\"0.002 1\" solimp=\"0.999 0.999 0.001 0.5 2\"/>\n"
           "<joint solimpfriction=\"0.999 0.999 0.001 0.5 2\"/></default>\n";
  }

  std::string next_body(const std::string& name, std::optional<LinkId> link) {
    mjcf_.bodies.push_back(name);
    link_of_body_.push_back(link);
    return attribute("name", "B" + std::to_string(mjcf_.bodies.size() - 1));
  }

  void write_link(std::size_t index) {
    const Link& link = cell_.links[index];
    const LinkId id{static_cast<std::uint32_t>(index)};
    bodies_ += "<body" + next_body(link.name, id) + pose(link.X_PJ) + ">\n";
    const std::string urdf_name = link.name.substr(cell_.robots[link.robot.index()].prefix.size());
    if (link.driver) write_joint(link, id, urdf_name);
    write_inertial(link, urdf_name);
    for (const PlacedShape& placed : link.shapes) write_shape(placed, link.name);
    if (options_.payload && options_.payload->link == link.name) {
      bodies_ += "<body>" +
                 inertial(sphere_inertia(options_.payload->mass_kg, kPayloadRadius_m,
                                         options_.payload->p_LC_m)) +
                 "</body>\n";
    }
    for (const std::size_t child : children_[index]) write_link(child);
    bodies_ += "</body>\n";
  }

  void write_joint(const Link& link, LinkId id, const std::string& urdf_name) {
    const Joint& joint = cell_.joint(*link.driver);
    const auto found = dynamics_.joints.find(urdf_name);
    const JointDynamics dynamics =
        found == dynamics_.joints.end() ? JointDynamics{} : found->second;
    if (!dynamics.effort_max) without_effort_.push_back(urdf_name);
    const double effort = dynamics.effort_max.value_or(kAssumedEffort);
    bodies_ += "<joint" + attribute("name", "J" + std::to_string(mjcf_.driven.size())) +
               attribute("type", link.motion == JointKind::prismatic ? "slide" : "hinge") +
               attribute("axis", row(link.axis)) +
               attribute("armature", text_of(effort * kArmaturePerEffort)) +
               attribute("damping", text_of(dynamics.damping));
    if (joint.has_lower() && joint.has_upper()) {
      const auto [low, high] = std::minmax({link.multiplier * joint.lower + link.offset,
                                            link.multiplier * joint.upper + link.offset});
      if (low < high)
        bodies_ += attribute("limited", "true") + attribute("range", row({low, high}));
    }
    bodies_ += "/>\n";
    mjcf_.driven.push_back(
        {id, *link.driver, link.multiplier, link.offset, effort, dynamics.friction});
  }

  void write_inertial(const Link& link, const std::string& urdf_name) {
    const auto given = dynamics_.links.find(urdf_name);
    LinkInertia inertia;
    if (given != dynamics_.links.end()) {
      inertia = given->second;
    } else if (!link.shapes.empty()) {
      if (std::any_of(link.shapes.begin(), link.shapes.end(), lacks_data)) return;
      inertia = inertia_of_shapes(link.shapes, kAssumedDensity_kg_m3);
      without_mass_.push_back(urdf_name);
      assumed_kg_ += inertia.mass_kg;
    } else if (!link.driver) {
      return;  // a frame
    } else {
      without_mass_.push_back(urdf_name);
    }
    if (inertia.mass_kg < kLightestLink_kg) {
      inertia = sphere_inertia(kLightestLink_kg, 0.01, inertia.p_LC);
    }
    bodies_ += inertial(inertia);
  }

  static bool lacks_data(const PlacedShape& placed) {
    const auto* mesh = std::get_if<Mesh>(&placed.shape);
    return mesh != nullptr && mesh->data == nullptr;
  }

  void write_shape(const PlacedShape& placed, const std::string& body) {
    const auto geom = [&](const char* type, const char* key, const std::string& value) {
      bodies_ +=
          "<geom" + attribute("type", type) + attribute(key, value) + pose(placed.X_LS) + "/>\n";
    };
    if (const auto* box = std::get_if<Box>(&placed.shape)) {
      geom("box", "size", row(box->size_m / 2.0));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&placed.shape)) {
      geom("cylinder", "size", row({cylinder->radius_m, cylinder->length_m / 2.0}));
    } else if (const auto* sphere = std::get_if<Sphere>(&placed.shape)) {
      geom("sphere", "size", text_of(sphere->radius_m));
    } else if (lacks_data(placed)) {
      problems_.push_back({ProblemKind::unsupported, "mesh-not-loaded", body,
                           "the mesh of " + body + " has not been loaded"});
    } else {
      const MeshData& data = *std::get<Mesh>(placed.shape).data;
      const std::vector<ConvexHull> whole = {data.hull};
      for (const ConvexHull& piece : data.pieces.empty() ? whole : data.pieces) {
        geom("mesh", "mesh", add_mesh(piece));
      }
    }
  }

  // Returns the name of the mesh.
  std::string add_mesh(const ConvexHull& hull) {
    std::string name = "M" + std::to_string(meshes_++);
    std::string vertices;
    for (const Eigen::Vector3d& vertex : hull.vertices) vertices += row(vertex) + " ";
    std::string faces;
    for (const auto& face : hull.faces) {
      for (const std::uint32_t corner : face) faces += std::to_string(corner) + " ";
    }
    assets_ += "<mesh" + attribute("name", name) + attribute("vertex", vertices) +
               attribute("face", faces) + "/>\n";
    return name;
  }

  void write_object(const CollisionObject& object) {
    bodies_ += "<body" + next_body(object.name, std::nullopt) + pose(object.X_WO) + ">\n";
    write_shape({object.shape, Eigen::Isometry3d::Identity()}, object.name);
    bodies_ += "</body>\n";
  }

  [[nodiscard]] bool may_touch(std::size_t a, std::size_t b) const {
    const auto link_a = link_of_body_[a];
    const auto link_b = link_of_body_[b];
    const bool a_moves = link_a && cell_.link(*link_a).arm;
    const bool b_moves = link_b && cell_.link(*link_b).arm;
    if (!a_moves && !b_moves) return true;
    if (link_a && link_b) return cell_.allowed.allows(*link_a, *link_b);
    return cell_.allowed.link_objects.contains(
        {link_a ? *link_a : *link_b, mjcf_.bodies[link_a ? b : a]});
  }

  [[nodiscard]] std::string excluded_pairs() const {
    std::string text;
    for (std::size_t a = 0; a < mjcf_.bodies.size(); ++a) {
      for (std::size_t b = a + 1; b < mjcf_.bodies.size(); ++b) {
        if (!may_touch(a, b)) continue;
        text += "<exclude" + attribute("body1", "B" + std::to_string(a)) +
                attribute("body2", "B" + std::to_string(b)) + "/>\n";
      }
    }
    return text;
  }

  // One for each driven link, in their order; MujocoModel switches them.
  [[nodiscard]] std::string locks() const {
    std::string text;
    for (std::size_t i = 0; i < mjcf_.driven.size(); ++i) {
      text += "<joint" + attribute("joint1", "J" + std::to_string(i)) +
              attribute("active", "false") + "/>\n";
    }
    return text;
  }

  void report_assumptions(const Robot& robot) {
    const auto warn = [&](const char* slug, const std::string& detail) {
      warnings_.push_back({ProblemKind::invalid, slug, "robot " + robot.name, detail});
    };
    if (!without_mass_.empty()) {
      warn("assumed-mass", std::to_string(without_mass_.size()) + " links have no <inertial> (" +
                               list_of(without_mass_) + "): physics assumes " +
                               text_of(std::round(assumed_kg_ * 100.0) / 100.0) +
                               " kg in total, from their shapes at " +
                               text_of(kAssumedDensity_kg_m3) + " kg/m^3");
    }
    if (!without_effort_.empty()) {
      warn("assumed-effort", "the joints of " + std::to_string(without_effort_.size()) +
                                 " links have no effort limit (" + list_of(without_effort_) +
                                 "): physics assumes " + text_of(kAssumedEffort) + " N m (N)");
    }
    without_mass_.clear();
    without_effort_.clear();
    assumed_kg_ = 0.0;
  }

  const Cell& cell_;
  const MjcfOptions& options_;
  Problems& warnings_;
  Problems problems_;
  Mjcf mjcf_;
  std::vector<std::optional<LinkId>> link_of_body_;
  std::vector<std::vector<std::size_t>> children_;
  RobotDynamics dynamics_;  // of the robot being written
  std::vector<std::string> without_mass_;
  std::vector<std::string> without_effort_;
  double assumed_kg_ = 0.0;
  std::string assets_;
  std::string bodies_;
  std::size_t meshes_ = 0;
};

}  // namespace

Result<Mjcf> make_mjcf(const Cell& cell, const MjcfOptions& options, Problems& warnings) {
  return Writer(cell, options, warnings).write();
}

}  // namespace armloom
