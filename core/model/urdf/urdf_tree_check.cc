#include <tinyxml2.h>

#include <string_view>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/model/urdf/urdf_check.h"
#include "core/model/xml/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    if (text.size() > 200) return text + ", ...";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

// Connects the links and joints of a mended robot to one tree. Precondition: names are unique. If a
// joint's child is missing, unknown or already moved by another joint, the joint gets a new child
// link. Other parts without a parent are attached to a new root link.
class TreeMender {
 public:
  TreeMender(XMLElement& robot, const std::string& file, UrdfNotes& notes, Diagnostics& diagnostics)
      : robot_(robot), file_(file), notes_(notes), diagnostics_(diagnostics) {}

  void mend() {
    const std::size_t before = diagnostics_.count();
    index_names();
    connect();
    if (all_children_known_) check_one_root();  // else a root may be a misspelled child
    notes_.patched = notes_.patched || diagnostics_.count() != before || !all_children_known_ ||
                     !notes_.loose.empty();
    fix_faulty_mimics();
    make_one_tree();
  }

 private:
  struct Node {
    std::string name;
    XMLElement* joint = nullptr;  // the joint that moves the link
    std::vector<const Node*> children;
  };

  void report(const std::string& slug, const std::string& sentence,
              const std::string& value) const {
    XmlPlace(file_, 0, "robot", diagnostics_).report(slug, sentence, value);
  }
  void report_joint(const std::string& name, const std::string& slug, const std::string& sentence,
                    const std::string& value) const {
    XmlPlace(file_, line_of("joint", name), "joint " + name, diagnostics_)
        .report(slug, sentence, value);
  }

  int line_of(const char* tag, const std::string& name) const {
    return notes_.lines.at(tag).at(name);
  }

  void index_names() {
    for (auto* child = robot_.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string name = child->Attribute("name");
      if (child->Name() == std::string("link"))
        links_[name].name = name;
      else
        joints_.emplace(name, child);
    }
  }

  Node* find_end(const std::string& joint, const std::string& end, const std::string& link) {
    const auto found = links_.find(link);
    if (found != links_.end()) return &found->second;
    if (end == "child") all_children_known_ = false;
    if (!link.empty())  // else reported with the element
      report_joint(joint, "unknown-link",
                   end + " link " + link + " does not exist" + did_you_mean(link, links_), link);
    return nullptr;
  }

  void connect() {
    for (const auto& [name, joint] : joints_) {
      const std::string link = joint->FirstChildElement("child")->Attribute("link");
      Node* parent =
          find_end(name, "parent", joint->FirstChildElement("parent")->Attribute("link"));
      Node* child = find_end(name, "child", link);
      if (child != nullptr && child->joint != nullptr) {
        report_joint(name, "two-parents",
                     "child link " + link + " already has the parent joint " +
                         child->joint->Attribute("name"),
                     link);
        all_children_known_ = false;  // the intended child is unknown
        child = nullptr;
      }
      if (child == nullptr) child = &childless_[name];
      child->joint = joint;
      if (parent != nullptr)
        parent->children.push_back(child);
      else
        notes_.loose.insert(link);
    }
  }

  std::string listed_with_lines(const std::set<std::string>& links) const {
    std::set<std::string> texts;
    for (const std::string& link : links)
      texts.insert(link + " (line " + std::to_string(line_of("link", link)) + ")");
    return listed(texts);
  }

  void check_one_root() {
    std::set<std::string> roots;
    std::set<std::string> hanging;
    for (const auto& [name, node] : links_) {
      if (node.joint != nullptr)
        hanging.insert(name);
      else if (!notes_.loose.contains(name))
        roots.insert(name);
    }
    if (links_.empty()) return report("missing", "there are no links: is it the robot's URDF?", "");
    if (roots.size() > 1)
      return report("two-roots",
                    "more than one root link: " + listed_with_lines(roots) +
                        "; attach all but one to a <joint>, for example of type=\"fixed\"",
                    listed(roots));
    for (const auto* starts : {&roots, &notes_.loose}) {
      for (const std::string& start : *starts) {
        if (links_.contains(start)) erase_tree(links_.at(start), hanging);
      }
    }
    if (hanging.empty()) return;
    report("loop", "links form a cycle without a root: " + listed_with_lines(hanging),
           listed(hanging));
  }

  static void erase_tree(const Node& root, std::set<std::string>& names) {
    names.erase(root.name);
    std::vector<const Node*> open{&root};
    while (!open.empty()) {
      const Node* node = open.back();
      open.pop_back();
      for (const Node* child : node->children) {
        if (names.erase(child->name) != 0) open.push_back(child);  // else visited: a loop
      }
    }
  }

  void fix_faulty_mimics() {
    std::vector<XMLElement*> faulty;
    for (const auto& [name, joint] : joints_) {
      const auto* mimic = joint->FirstChildElement("mimic");
      if (mimic != nullptr && !is_mimic_right(name, mimic->Attribute("joint")))
        faulty.push_back(joint);
    }
    for (XMLElement* joint : faulty) {
      joint->SetAttribute("type", "fixed");
      joint->DeleteChild(joint->FirstChildElement("mimic"));
    }
  }

  std::string known_joint_instead_of(const std::string& unknown) const {
    const std::string meant = did_you_mean(unknown, joints_);
    if (!meant.empty()) return meant;
    std::set<std::string> movable;
    for (const auto& [name, joint] : joints_) {
      const bool fixed = joint->Attribute("type", "fixed") != nullptr;
      if (!fixed && joint->FirstChildElement("mimic") == nullptr) movable.insert(name);
    }
    return "; joints that it could follow: " + (movable.empty() ? "none" : listed(movable));
  }

  bool is_mimic_right(const std::string& name, const std::string& followed) const {
    if (followed.empty()) return false;  // reported with the element
    const auto refuse = [&](const std::string& slug, const std::string& sentence) {
      report_joint(name, slug, sentence, followed);
      return false;
    };
    const auto driver = joints_.find(followed);
    if (driver == joints_.end())
      return refuse("unknown-joint", "mimic joint " + followed + " does not exist" +
                                         known_joint_instead_of(followed));
    if (followed == name) return refuse("mimic-ring", "the joint mimics itself");
    if (driver->second->Attribute("type", "fixed") != nullptr)
      return refuse("mimic-fixed", "mimic joint " + followed + " is fixed");
    // Follow the chain of mimics. Another fault in the chain is reported with the joint that has
    // it.
    std::set<std::string> passed{name};
    for (auto next = driver; next != joints_.end() && !next->second->Attribute("type", "fixed");) {
      const auto* mimic = next->second->FirstChildElement("mimic");
      if (mimic == nullptr) return true;
      if (!passed.insert(next->first).second)
        return refuse("mimic-ring",
                      "mimic joint " + followed + " and the joints that it follows form a cycle");
      next = joints_.find(mimic->Attribute("joint"));
    }
    return false;
  }

  void make_one_tree() {
    std::vector<const Node*> nodes;
    std::set<std::string> names;
    for (auto& [joint, node] : childless_) {
      node.name = make("link", "child of " + joint).Attribute("name");
      node.joint->FirstChildElement("child")->SetAttribute("link", node.name.c_str());
    }
    for (const auto* some : {&links_, &childless_}) {
      for (const auto& [name, node] : *some) {
        // Roots come first. Nodes that they do not reach are in loops, or their joint has no
        // parent.
        nodes.insert(node.joint == nullptr ? nodes.begin() : nodes.end(), &node);
        names.insert(node.name);
      }
    }
    std::vector<const Node*> roots;
    for (const Node* node : nodes) {
      if (!names.contains(node->name)) continue;
      roots.push_back(node);
      erase_tree(*node, names);
    }
    if (roots.size() == 1 && roots.front()->joint == nullptr) return;
    const std::string above = make("link", "above all").Attribute("name");
    for (const Node* root : roots) hang(*root, above);
  }

  void hang(const Node& root, const std::string& above) {
    XMLElement* joint = root.joint;
    if (joint == nullptr) {
      joint = &make("joint", "above " + root.name);
      joint->SetAttribute("type", "fixed");
      joint->InsertNewChildElement("parent");
      joint->InsertNewChildElement("child")->SetAttribute("link", root.name.c_str());
    }
    joint->FirstChildElement("parent")->SetAttribute("link", above.c_str());
  }

  XMLElement& make(const char* tag, std::string name) {
    while (links_.contains(name) || joints_.contains(name) || notes_.made.contains(name))
      name += "'";
    notes_.made.insert(name);
    XMLElement& element = *robot_.InsertNewChildElement(tag);
    element.SetAttribute("name", name.c_str());
    return element;
  }

  XMLElement& robot_;
  const std::string& file_;
  UrdfNotes& notes_;
  Diagnostics& diagnostics_;
  std::map<std::string, Node> links_;
  std::map<std::string, XMLElement*> joints_;
  std::map<std::string, Node> childless_;  // by name of the joint that has no child of its own
  bool all_children_known_ = true;
};

}  // namespace

void check_urdf_tree(XMLElement& mended, const std::string& file, UrdfNotes& notes,
                     Diagnostics& diagnostics) {
  TreeMender(mended, file, notes, diagnostics).mend();
}

}  // namespace armloom
