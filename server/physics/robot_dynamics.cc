#include "server/physics/robot_dynamics.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "core/model/xml/xml_numbers.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

// Reads numbers of one element, and remembers whether one of them was faulty.
class Numbers {
 public:
  // Returns `absent` if the element or the attribute is missing.
  double one(const XMLElement* element, const char* name, double absent) {
    const auto numbers = read(element, name, 1);
    return numbers.empty() ? absent : numbers.front();
  }
  Eigen::Vector3d three(const XMLElement* element, const char* name) {
    const auto numbers = read(element, name, 3);
    return numbers.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(numbers.data());
  }
  [[nodiscard]] bool is_faulty() const { return faulty_; }

 private:
  std::vector<double> read(const XMLElement* element, const char* name, std::size_t size) {
    const char* text = element == nullptr ? nullptr : element->Attribute(name);
    if (text == nullptr) return {};
    auto numbers = parse_numbers(text);
    if (numbers && numbers->size() == size) return std::move(*numbers);
    faulty_ = true;
    return {};
  }

  bool faulty_ = false;
};

// Returns nullopt for a faulty or impossible inertia. The mass is zero if the URDF says so.
std::optional<LinkInertia> inertia_of(const XMLElement& inertial) {
  Numbers numbers;
  const XMLElement* origin = inertial.FirstChildElement("origin");
  const XMLElement* inertia = inertial.FirstChildElement("inertia");
  const Eigen::Vector3d rpy = numbers.three(origin, "rpy");
  const auto entry = [&](const char* name) { return numbers.one(inertia, name, 0.0); };
  const double xy = entry("ixy");
  const double xz = entry("ixz");
  const double yz = entry("iyz");
  Eigen::Matrix3d I_C;  // axes of the <origin>
  I_C << entry("ixx"), xy, xz, xy, entry("iyy"), yz, xz, yz, entry("izz");
  const Eigen::Matrix3d R_LC = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  LinkInertia link{numbers.one(inertial.FirstChildElement("mass"), "value", 0.0),
                   numbers.three(origin, "xyz"), R_LC * I_C * R_LC.transpose()};
  const bool is_nothing = link.mass_kg == 0.0 && link.I_C_kg_m2.isZero(0.0);
  if (numbers.is_faulty() || !(is_nothing || link.is_possible())) return std::nullopt;
  return link;
}

}  // namespace

RobotDynamics read_dynamics(const std::string& urdf_text, const std::string& robot,
                            Problems& warnings) {
  RobotDynamics dynamics;
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf_text.c_str(), urdf_text.size()) != tinyxml2::XML_SUCCESS) return dynamics;
  const XMLElement* root = document.RootElement();
  const auto warn = [&](const std::string& place, const std::string& detail) {
    warnings.push_back(
        {ProblemKind::invalid, "faulty-dynamics", "robot " + robot + ": " + place, detail});
  };
  for (const XMLElement* link = root->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const XMLElement* inertial = link->FirstChildElement("inertial");
    const char* name = link->Attribute("name");
    if (inertial == nullptr || name == nullptr) continue;
    if (auto inertia = inertia_of(*inertial)) {
      if (inertia->mass_kg > 0.0) dynamics.links.emplace(name, *inertia);
    } else {
      warn("link " + std::string(name),
           "its <inertial> is not possible (the mass must be positive, and no principal moment "
           "negative or above the sum of the others), so its mass is assumed from its shapes");
    }
  }
  for (const XMLElement* joint = root->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const XMLElement* child = joint->FirstChildElement("child");
    const char* link = child == nullptr ? nullptr : child->Attribute("link");
    if (link == nullptr) continue;
    Numbers numbers;
    const XMLElement* losses = joint->FirstChildElement("dynamics");
    JointDynamics read;
    const double effort = numbers.one(joint->FirstChildElement("limit"), "effort", 0.0);
    if (effort > 0.0) read.effort_max = effort;
    read.damping = numbers.one(losses, "damping", 0.0);
    read.friction = numbers.one(losses, "friction", 0.0);
    if (numbers.is_faulty() || effort < 0.0 || read.damping < 0.0 || read.friction < 0.0) {
      const char* name = joint->Attribute("name");
      warn("joint " + std::string(name == nullptr ? "" : name),
           "effort, damping or friction is not a number of at least 0, so defaults apply");
      read = {};
    }
    dynamics.joints.emplace(link, read);
  }
  return dynamics;
}

}  // namespace armloom
