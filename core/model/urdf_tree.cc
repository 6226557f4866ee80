#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/model/urdf_elements.h"
#include "core/model/xml_element.h"

namespace armloom {
namespace {

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    if (text.size() > 200) return text + ", ...";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

// Connects a URDF's elements. A joint belongs to the link that it moves; a joint whose child is
// missing, unknown or moved by another one gets a link without a name.
class TreeMaker {
 public:
  TreeMaker(UrdfElements elements, const std::string& file, Findings& findings)
      : elements_(std::move(elements)), file_(file), findings_(findings) {}

  RobotTree make() {
    const std::size_t before = findings_.count();
    tree_.file = file_;
    index_names();
    connect();
    if (all_children_known_) check_one_root();  // else a root may only be misspelt elsewhere
    tree_.patched = findings_.count() != before || !all_children_known_ || !loose_.empty();
    place_all();
    connect_mimics();
    return std::move(tree_);
  }

 private:
  struct Node {
    UrdfLink link;
    UrdfJoint* joint = nullptr;   // above it
    std::vector<Node*> children;  // by the names of their joints
    bool placed = false;
  };

  void report(const std::string& what, const std::string& name, const std::string& slug,
              const std::string& sentence, const std::string& value) const {
    XmlPlace(file_ + ": " + what + (what == "robot" ? "" : " " + name), findings_)
        .report(slug, sentence, value);
  }

  // Whether the element has a name that is not taken.
  template <class Element, class Known>
  bool is_new(const std::string& tag, const Element& element, const Known& known) const {
    if (element.name.empty()) {
      XmlPlace(file_ + ": " + tag + " at line " + std::to_string(element.line), findings_)
          .report("missing", tag + " name is missing");
      return false;
    }
    if (!known.contains(element.name)) return true;
    report(tag, element.name, "duplicate-name", "more than one " + tag + " has this name",
           element.name);
    return false;
  }

  void index_names() {
    for (UrdfLink& link : elements_.links) {
      if (!is_new("link", link, links_)) continue;
      const std::string name = link.name;
      links_[name].link = std::move(link);
    }
    for (UrdfJoint& joint : elements_.joints) {
      if (is_new("joint", joint, joints_))
        joints_.emplace(joint.name, &joint);
      else
        loose_.insert(joint.child);
    }
  }

  Node* find_end(const UrdfJoint& joint, const char* end, const std::string& link) {
    if (link.empty()) {  // told by the reader of the element
      all_children_known_ = all_children_known_ && std::string(end) != "child";
      return nullptr;
    }
    const auto found = links_.find(link);
    if (found != links_.end()) return &found->second;
    all_children_known_ = all_children_known_ && std::string(end) != "child";
    report("joint", joint.name, "unknown-link",
           std::string(end) + " link " + link + " does not exist", link);
    return nullptr;
  }

  void connect() {
    for (const auto& [name, joint] : joints_) {
      Node* parent = find_end(*joint, "parent", joint->parent);
      Node* child = find_end(*joint, "child", joint->child);
      if (child != nullptr && child->joint != nullptr) {
        report("joint", name, "two-parents",
               "child link " + joint->child + " already hangs on joint " + child->joint->name,
               joint->child);
        all_children_known_ = false;  // which link this one was to move
        child = nullptr;
      }
      if (child == nullptr) child = &nameless_[name];
      child->joint = joint;
      if (parent != nullptr)
        parent->children.push_back(child);
      else
        loose_.insert(joint->child);
    }
  }

  void check_one_root() {
    std::set<std::string> roots;
    std::set<std::string> hanging;
    for (const auto& [name, node] : links_) {
      if (node.joint != nullptr)
        hanging.insert(name);
      else if (!loose_.contains(name))
        roots.insert(name);
    }
    if (links_.empty()) return report("robot", "", "missing", "there are no links", tree_.name);
    if (roots.size() > 1)
      return report("robot", "", "two-roots", "more than one root link: " + listed(roots),
                    listed(roots));
    for (const auto* starts : {&roots, &loose_}) {
      for (const std::string& start : *starts) {
        if (links_.contains(start)) erase_below(links_.at(start), hanging);
      }
    }
    if (hanging.empty()) return;
    report("robot", "", "loop", "links hang in a loop and not below a root: " + listed(hanging),
           listed(hanging));
  }

  static void erase_below(const Node& root, std::set<std::string>& names) {
    std::vector<const Node*> open{&root};
    while (!open.empty()) {
      const Node* node = open.back();
      open.pop_back();
      if (names.erase(node->link.name) == 0 && node != &root) continue;  // seen: a loop
      open.insert(open.end(), node->children.begin(), node->children.end());
    }
  }

  // Roots first; what then is left hangs in loops, or on nothing.
  void place_all() {
    for (auto& [name, node] : links_) {
      if (node.joint == nullptr) place(node);
    }
    for (auto& [name, node] : links_) place(node);
    for (auto& [name, node] : nameless_) place(node);
  }

  void place(Node& root) {
    std::vector<std::pair<Node*, std::optional<std::size_t>>> open{{&root, std::nullopt}};
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      if (std::exchange(node->placed, true)) continue;
      const std::size_t index = tree_.links.size();
      add(*node, parent, index);
      for (auto child = node->children.rbegin(); child != node->children.rend(); ++child)
        open.emplace_back(*child, index);
    }
  }

  void add(Node& node, std::optional<std::size_t> parent, std::size_t index) {
    TreeLink link;
    link.name = node.link.name;
    link.parent = parent;
    link.shapes = std::move(node.link.shapes);
    if (!link.name.empty()) tree_.by_link.emplace(link.name, index);
    if (node.joint != nullptr) {
      link.joint = node.joint->name;
      link.motion = node.joint->motion;
      link.many_values = node.joint->many_values;
      link.X_PJ = node.joint->X_PJ;
      link.axis = node.joint->axis;
      link.limits = std::move(node.joint->limits);
      tree_.by_joint.emplace(link.joint, index);
    }
    tree_.links.push_back(std::move(link));
  }

  void connect_mimics() {
    for (const auto& [name, joint] : joints_) {
      if (!joint->mimic) continue;
      TreeLink& link = tree_.links[tree_.by_joint.at(name)];
      if (const auto driver = find_driver(*joint))
        link.mimic = TreeLink::Mimic{*driver, joint->mimic->multiplier, joint->mimic->offset};
      else
        link.motion = std::nullopt;
    }
  }

  std::optional<std::size_t> find_driver(const UrdfJoint& joint) {
    const std::string& followed = joint.mimic->joint;
    const auto refuse = [&](const std::string& slug, const std::string& sentence) {
      report("joint", joint.name, slug, sentence, followed);
      return std::nullopt;
    };
    if (followed.empty()) return std::nullopt;  // told by the reader of the element
    const auto driver = joints_.find(followed);
    if (driver == joints_.end())
      return refuse("unknown-joint", "mimic joint " + followed + " does not exist");
    if (followed == joint.name) return refuse("mimic-chain", "the joint mimics itself");
    if (driver->second->mimic)
      return refuse("mimic-chain", "mimic joint " + followed + " is a mimic itself");
    if (!driver->second->motion)
      return refuse("mimic-fixed", "mimic joint " + followed + " is fixed");
    return tree_.by_joint.at(followed);
  }

  UrdfElements elements_;
  const std::string& file_;
  Findings& findings_;
  RobotTree tree_;
  std::map<std::string, Node> links_;
  std::map<std::string, UrdfJoint*> joints_;
  std::map<std::string, Node> nameless_;  // of a joint without a link of its own
  std::set<std::string> loose_;           // links that hang on nothing because of what was told
  bool all_children_known_ = true;
};

}  // namespace

RobotTree make_tree(UrdfElements elements, const std::string& file, Findings& findings) {
  return TreeMaker(std::move(elements), file, findings).make();
}

}  // namespace armloom
