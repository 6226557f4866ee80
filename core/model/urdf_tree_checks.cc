#include <tinyxml2.h>

#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "core/model/urdf_checks.h"
#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

struct Names {
  std::map<std::string, const XMLElement*> links;
  std::map<std::string, const XMLElement*> joints;
};

Names unique_names(const XMLElement& robot, const std::string& file, Findings& findings) {
  Names names;
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string tag = child->Name();
    if (tag != "link" && tag != "joint") continue;
    const XmlPlace at_line(file + ": " + tag + " at line " + std::to_string(child->GetLineNum()),
                           findings);
    const std::string name = at_line.name(*child, "name");
    if (name.empty()) continue;
    auto& known = tag == "link" ? names.links : names.joints;
    if (!known.emplace(name, child).second) {
      XmlPlace(file + ": " + tag + " " + name, findings)
          .report("duplicate-name", "more than one " + tag + " has this name", name);
    }
  }
  return names;
}

// The link that <parent> or <child> of a joint names; empty and reported when there is none.
std::string link_at(const XMLElement& joint, const char* end, const Names& names,
                    const XmlPlace& place) {
  const auto* element = place.only_child(joint, end, Presence::required);
  if (element == nullptr) return {};
  std::string link = place.name(*element, "link");
  if (link.empty() || names.links.contains(link)) return link;
  place.report("unknown-link", std::string(end) + " link " + link + " does not exist", link);
  return {};
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    if (text.size() > 200) return text + ", ...";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

// Every link below `root`; the rest hangs in loops.
std::set<std::string> without_reachable(std::set<std::string> links, const std::string& root,
                                        const std::multimap<std::string, std::string>& children) {
  std::vector<std::string> open{root};
  while (!open.empty()) {
    const std::string link = open.back();
    open.pop_back();
    if (links.erase(link) == 0) continue;
    const auto [begin, end] = children.equal_range(link);
    for (auto child = begin; child != end; ++child) open.push_back(child->second);
  }
  return links;
}

void check_connections(const Names& names, const std::string& file, Findings& findings) {
  std::multimap<std::string, std::string> children;  // parent link -> child link
  std::map<std::string, std::string> joint_above;    // child link -> joint
  const std::size_t before = findings.count();
  for (const auto& [name, joint] : names.joints) {
    const XmlPlace place(file + ": joint " + name, findings);
    const std::string parent = link_at(*joint, "parent", names, place);
    const std::string child = link_at(*joint, "child", names, place);
    if (parent.empty() || child.empty()) continue;
    children.emplace(parent, child);
    const auto [above, first] = joint_above.emplace(child, name);
    if (!first) {
      place.report("two-parents",
                   "child link " + child + " already hangs on joint " + above->second, child);
    }
  }
  if (findings.count() != before) return;  // roots and loops would only repeat it

  const XmlPlace place(file + ": robot", findings);
  std::set<std::string> links;
  std::set<std::string> roots;
  for (const auto& [link, element] : names.links) {
    links.insert(link);
    if (!joint_above.contains(link)) roots.insert(link);
  }
  if (links.empty()) return place.report("missing", "there are no links");
  if (roots.size() > 1) {
    return place.report("two-roots", "more than one root link: " + listed(roots), listed(roots));
  }
  const auto loop = roots.empty() ? links : without_reachable(links, *roots.begin(), children);
  if (!loop.empty()) {
    place.report("loop", "links hang in a loop and not below a root: " + listed(loop),
                 listed(loop));
  }
}

void check_mimics(const Names& names, const std::string& file, Findings& findings) {
  for (const auto& [name, joint] : names.joints) {
    const auto* mimic = joint->FirstChildElement("mimic");
    if (mimic == nullptr) continue;
    const XmlPlace place(file + ": joint " + name, findings);
    const std::string followed = place.name(*mimic, "joint");
    if (followed.empty()) continue;
    const auto driver = names.joints.find(followed);
    if (driver == names.joints.end()) {
      place.report("unknown-joint", "mimic joint " + followed + " does not exist", followed);
    } else if (followed == name) {
      place.report("mimic-chain", "the joint mimics itself", followed);
    } else if (driver->second->FirstChildElement("mimic") != nullptr) {
      place.report("mimic-chain", "mimic joint " + followed + " is a mimic itself", followed);
    } else if (const char* type = driver->second->Attribute("type");
               type != nullptr && std::string_view(type) == "fixed") {
      place.report("mimic-fixed", "mimic joint " + followed + " is fixed", followed);
    }
  }
}

}  // namespace

void check_urdf_tree(const XMLElement& robot, const std::string& file, Findings& findings) {
  const std::size_t before = findings.count();
  const Names names = unique_names(robot, file, findings);
  if (findings.count() != before) return;  // what hangs where is only clear between unique names
  check_connections(names, file, findings);
  check_mimics(names, file, findings);
}

}  // namespace armloom
