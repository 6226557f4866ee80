#include "core/model/urdf/urdf_model.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <utility>
#include <vector>

#include "core/model/xml/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

// Collects urdfdom's messages separately for each thread, because console_bridge has one handler
// for all threads.
class UrdfdomWords : public console_bridge::OutputHandler {
 public:
  static std::string& said() {
    thread_local std::string words;
    return words;
  }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && said().size() < 1000)
      said() += (said().empty() ? "" : "; ") + text;
  }
};

urdf::ModelInterfaceSharedPtr parse(const XMLElement& robot) {
  static UrdfdomWords words;
  static const bool listening = (console_bridge::useOutputHandler(&words), true);
  static_cast<void>(listening);
  UrdfdomWords::said().clear();
  tinyxml2::XMLPrinter printer(nullptr, true);
  robot.Accept(&printer);
  try {
    return urdf::parseURDF(printer.CStr());
  } catch (const std::exception& error) {
    UrdfdomWords::said() = error.what();
    return nullptr;
  }
}

// Returns false if urdfdom dropped parts, such as collisions that it rejects.
bool is_complete(const urdf::ModelInterface& model, const XMLElement& robot) {
  for (const auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const auto read = model.getLink(link->Attribute("name"));
    if (read == nullptr || read->collision_array.size() != count_children(*link, "collision"))
      return false;
  }
  return model.joints_.size() == count_children(robot, "joint");
}

Eigen::Vector3d vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  const auto& r = pose.rotation;  // of norm 1
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix();
  X.translation() = vector_of(pose.position);
  return X;
}

Shape shape_of(const urdf::Geometry& geometry, const UrdfNotes& notes) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) return Box{vector_of(box->dim)};
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry))
    return Sphere{sphere->radius};
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry))
    return Cylinder{cylinder->radius, cylinder->length};
  const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
  return Mesh{notes.meshes.at(mesh.filename), vector_of(mesh.scale)};
}

void take_joint(const urdf::Joint& joint, UrdfNotes::Joint notes, TreeJoint& taken) {
  taken.name = joint.name;
  taken.X_PJ = pose_of(joint.parent_to_joint_origin_transform);
  taken.many_values = notes.many_values;
  if (joint.type == urdf::Joint::FIXED) return;
  taken.motion = joint.type == urdf::Joint::PRISMATIC    ? JointKind::prismatic
                 : joint.type == urdf::Joint::CONTINUOUS ? JointKind::continuous
                                                         : JointKind::revolute;
  taken.axis = vector_of(joint.axis).normalized();
  if (notes.lower) taken.limits.lower = joint.limits->lower;
  if (notes.upper) taken.limits.upper = joint.limits->upper;
  if (notes.velocity) taken.limits.velocity = joint.limits->velocity;
  taken.limits.faults = std::move(notes.faults);
}

// Precondition: mimic joints form no cycle (check_urdf_tree).
TreeJoint::Mimic mimic_of(const urdf::Joint& joint, const urdf::ModelInterface& model,
                          const RobotTree& tree) {
  const urdf::JointMimic& own = *joint.mimic;
  const urdf::Joint& followed = *model.joints_.at(own.joint_name);
  if (!followed.mimic) return {tree.by_joint.at(own.joint_name), own.multiplier, own.offset};
  const TreeJoint::Mimic far = mimic_of(followed, model, tree);
  return {far.driver, own.multiplier * far.multiplier, own.multiplier * far.offset + own.offset};
}

RobotTree tree_of(const urdf::ModelInterface& model, UrdfNotes notes) {
  RobotTree tree;
  tree.name = model.getName();
  tree.patched = notes.patched;
  tree.nameless = notes.nameless;
  std::vector<std::pair<const urdf::Link*, std::optional<std::size_t>>> open{
      {model.getRoot().get(), std::nullopt}};
  while (!open.empty()) {
    const auto [source, parent] = open.back();
    open.pop_back();
    std::optional<std::size_t> index;
    if (source->parent_joint != nullptr || !notes.made.contains(source->name)) {
      index = tree.links.size();
      TreeLink& link = tree.links.emplace_back();
      link.parent = parent;
      const urdf::Joint* joint = source->parent_joint.get();
      if (joint != nullptr && !notes.made.contains(joint->name)) {
        take_joint(*joint, std::move(notes.joints.at(joint->name)), link.joint);
        link.joint.line = notes.lines.at("joint").at(joint->name);
        tree.by_joint.emplace(joint->name, *index);
      }
      for (const auto& collision : source->collision_array)
        link.shapes.push_back({shape_of(*collision->geometry, notes), pose_of(collision->origin)});
      if (!notes.made.contains(source->name)) {
        link.name = source->name;
        link.seen = notes.seen.contains(link.name);
        link.solid = notes.solid.contains(link.name);
        link.line = notes.lines.at("link").at(link.name);
        tree.by_link.emplace(link.name, *index);
      }
    }
    for (auto child = source->child_links.rbegin(); child != source->child_links.rend(); ++child)
      open.emplace_back(child->get(), index);
  }
  for (const auto& [name, joint] : model.joints_) {
    if (joint->mimic)
      tree.links[tree.by_joint.at(name)].joint.mimic = mimic_of(*joint, model, tree);
  }
  return tree;
}

}  // namespace

std::optional<RobotTree> read_with_urdfdom(const XMLElement& mended, const std::string& file,
                                           UrdfNotes notes, Diagnostics& diagnostics) {
  const auto model = parse(mended);
  if (model != nullptr && is_complete(*model, mended)) {
    RobotTree tree = tree_of(*model, std::move(notes));
    tree.file = file;
    return tree;
  }
  XmlPlace(file, 0, "robot", diagnostics)
      .report("urdf-refused", "urdfdom cannot read it: " + UrdfdomWords::said());
  return std::nullopt;
}

}  // namespace armloom
