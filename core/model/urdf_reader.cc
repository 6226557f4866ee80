#include "core/model/urdf_reader.h"

#include <tinyxml2.h>

#include <utility>

#include "core/model/urdf_elements.h"
#include "core/model/xml_element.h"

namespace armloom {

std::optional<RobotTree> read_urdf(std::string text, const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& packages,
                                   Findings& findings) {
  const std::string file = path.filename().string();
  tinyxml2::XMLDocument document;
  const auto* robot = parse_robot_xml(text, file, document, findings);
  if (robot == nullptr) return std::nullopt;
  const XmlPlace place(file + ": robot", findings);
  const std::string name = place.name(*robot, "name");
  UrdfElements elements =
      read_urdf_elements(*robot, file, {path.parent_path(), &packages}, findings);
  if (elements.links.size() > kMaxLinksOfRobot) {
    place.report("too-many-links",
                 std::to_string(elements.links.size()) + " links, at most " +
                     std::to_string(kMaxLinksOfRobot) + " are allowed",
                 static_cast<double>(elements.links.size()), ProblemKind::too_large);
    return std::nullopt;
  }
  RobotTree tree = make_tree(std::move(elements), file, findings);
  tree.name = name;
  tree.text = std::move(text);
  return tree;
}

}  // namespace armloom
