#include "core/model/urdf_reader.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>

#include "core/model/mesh_path.h"
#include "core/model/urdf_checks.h"
#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

void keep_children(XMLElement& element, std::initializer_list<std::string_view> kept) {
  for (auto* child = element.FirstChild(); child != nullptr;) {
    auto* next = child->NextSibling();
    const auto* inner = child->ToElement();
    if (inner == nullptr || std::find(kept.begin(), kept.end(), inner->Name()) == kept.end()) {
      element.DeleteChild(child);
    }
    child = next;
  }
}

// What the model needs of the document, as text again: urdfdom then reads exactly what was checked,
// and cannot stumble over visuals or extensions that we do not use.
std::string essence(XMLElement& robot) {
  robot.DeleteAttribute("version");
  keep_children(robot, {"link", "joint"});
  for (auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string_view(child->Name()) == "link") {
      keep_children(*child, {"collision"});
    } else if (std::string_view(child->Attribute("type")) == "fixed") {
      keep_children(*child, {"origin", "parent", "child"});
    } else {
      keep_children(*child, {"origin", "parent", "child", "axis", "limit", "mimic"});
    }
  }
  tinyxml2::XMLPrinter printer(nullptr, true);
  robot.Accept(&printer);
  return printer.CStr();
}

urdf::ModelInterfaceSharedPtr parse_with_urdfdom(const std::string& xml) {
  // urdfdom writes to the console; our users get one sentence instead.
  static const bool silenced = [] {
    console_bridge::noOutputHandler();
    return true;
  }();
  static_cast<void>(silenced);
  try {
    return urdf::parseURDF(xml);
  } catch (const std::exception&) {
    return nullptr;
  }
}

std::size_t links_written(const XMLElement& robot) {
  std::size_t count = 0;
  for (const auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    ++count;
  }
  return count;
}

std::size_t collisions_written(const XMLElement& robot, const std::string& link_name) {
  std::size_t count = 0;
  for (const auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    if (link_name != link->Attribute("name")) continue;
    for (const auto* collision = link->FirstChildElement("collision"); collision != nullptr;
         collision = collision->NextSiblingElement("collision")) {
      ++count;
    }
  }
  return count;
}

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  const auto& r = pose.rotation;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  X.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return X;
}

struct MeshFolders {
  std::filesystem::path urdf_folder;
  const std::map<std::string, std::string>* packages;
};

std::optional<Shape> shape_of(const urdf::Geometry& geometry, const MeshFolders& folders,
                              const XmlPlace& place) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    return Box{Eigen::Vector3d(box->dim.x, box->dim.y, box->dim.z)};
  }
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    return Cylinder{cylinder->radius, cylinder->length};
  }
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry))
    return Sphere{sphere->radius};
  const auto* mesh = dynamic_cast<const urdf::Mesh*>(&geometry);
  if (mesh == nullptr) return std::nullopt;
  const auto path = resolve_mesh(mesh->filename, folders.urdf_folder, *folders.packages);
  if (!path) {
    place.report("mesh-unresolved", "mesh " + mesh->filename + " " + path.error(), mesh->filename);
    return std::nullopt;
  }
  return Mesh{path->string(), Eigen::Vector3d(mesh->scale.x, mesh->scale.y, mesh->scale.z)};
}

void read_joint(const urdf::Joint& joint, TreeLink& link) {
  link.joint = joint.name;
  link.X_PJ = pose_of(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::FIXED) return;
  link.motion = joint.type == urdf::Joint::PRISMATIC    ? JointKind::prismatic
                : joint.type == urdf::Joint::CONTINUOUS ? JointKind::continuous
                                                        : JointKind::revolute;
  link.axis = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool endless = *link.motion == JointKind::continuous;
  link.lower = endless ? -kInfinity : joint.limits->lower;
  link.upper = endless ? kInfinity : joint.limits->upper;
  link.velocity_max = joint.limits->velocity;
}

void read_shapes(const urdf::Link& source, const MeshFolders& folders, const XmlPlace& place,
                 TreeLink& link) {
  for (const auto& collision : source.collision_array) {
    if (auto shape = shape_of(*collision->geometry, folders, place)) {
      link.shapes.push_back({std::move(*shape), pose_of(collision->origin)});
    }
  }
}

// Appends the links depth first, so that parents come before children and a chain stays together.
void read_links(const urdf::ModelInterface& model, const XMLElement& robot,
                const MeshFolders& folders, Findings& findings, RobotTree& tree) {
  std::vector<std::pair<urdf::LinkConstSharedPtr, std::optional<std::size_t>>> open{
      {model.getRoot(), std::nullopt}};
  while (!open.empty()) {
    const auto [source, parent] = open.back();
    open.pop_back();
    const XmlPlace place(tree.file + ": link " + source->name, findings);
    TreeLink link;
    link.name = source->name;
    link.parent = parent;
    if (source->parent_joint != nullptr) read_joint(*source->parent_joint, link);
    if (source->collision_array.size() != collisions_written(robot, source->name)) {
      place.report("urdf-refused", "urdfdom read only some of its collision elements");
    }
    read_shapes(*source, folders, place, link);
    const std::size_t index = tree.links.size();
    tree.by_link.emplace(link.name, index);
    if (parent) tree.by_joint.emplace(link.joint, index);
    tree.links.push_back(std::move(link));
    for (auto child = source->child_links.rbegin(); child != source->child_links.rend(); ++child) {
      open.emplace_back(*child, index);
    }
  }
  for (auto& link : tree.links) {
    if (!link.parent) continue;
    const auto& mimic = model.getJoint(link.joint)->mimic;
    if (mimic != nullptr) {
      link.mimic =
          TreeLink::Mimic{tree.by_joint.at(mimic->joint_name), mimic->multiplier, mimic->offset};
    }
  }
}

}  // namespace

std::optional<RobotTree> read_urdf(std::string text, const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& packages,
                                   Findings& findings) {
  RobotTree tree;
  tree.file = path.filename().string();
  tree.text = std::move(text);
  const std::size_t before = findings.count();

  tinyxml2::XMLDocument document;
  auto* robot = parse_robot_xml(tree.text, tree.file, document, findings);
  if (robot == nullptr) return std::nullopt;
  check_urdf_elements(*robot, tree.file, findings);
  check_urdf_tree(*robot, tree.file, findings);
  if (findings.count() != before) return std::nullopt;

  const auto model = parse_with_urdfdom(essence(*robot));
  if (model == nullptr || model->getRoot() == nullptr ||
      model->links_.size() != links_written(*robot)) {
    XmlPlace(tree.file + ": robot", findings)
        .report("urdf-refused", "urdfdom cannot read the file");
    return std::nullopt;
  }
  read_links(*model, *robot, MeshFolders{path.parent_path(), &packages}, findings, tree);
  if (findings.count() != before) return std::nullopt;
  return tree;
}

}  // namespace armloom
