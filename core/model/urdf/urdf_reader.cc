#include "core/model/urdf/urdf_reader.h"

#include <tinyxml2.h>

#include <utility>

#include "core/model/urdf/urdf_check.h"
#include "core/model/urdf/urdf_model.h"
#include "core/model/xml/robot_file.h"
#include "core/model/xml/xml_element.h"

namespace armloom {

RobotTree unread_robot(const std::filesystem::path& path) {
  RobotTree tree;
  tree.file = told_file_name(path);
  tree.patched = true;
  tree.nameless = true;
  return tree;
}

std::optional<RobotTree> read_urdf(std::string text, const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& packages,
                                   Diagnostics& diagnostics) {
  const std::string file = told_file_name(path);
  tinyxml2::XMLDocument document;
  const auto* robot = parse_robot_xml(text, file, document, diagnostics);
  if (robot == nullptr) return std::nullopt;
  const XmlPlace place(file, robot->GetLineNum(), "robot", diagnostics);
  tinyxml2::XMLDocument document_of_mended;
  auto* mended = document_of_mended.NewElement("robot");
  document_of_mended.InsertEndChild(mended);
  mended->SetAttribute("name", place.name(*robot, "name").c_str());
  UrdfNotes notes =
      check_urdf_elements(*robot, file, {path.parent_path(), &packages}, *mended, diagnostics);
  const std::size_t links = count_children(*robot, "link");
  if (links > kMaxLinksOfRobot) {
    place.report("too-many-links",
                 std::to_string(links) + " links, at most " + std::to_string(kMaxLinksOfRobot) +
                     " are allowed",
                 static_cast<double>(links), ProblemKind::too_large);
    return std::nullopt;
  }
  check_urdf_tree(*mended, file, notes, diagnostics);
  auto tree = read_with_urdfdom(*mended, file, std::move(notes), diagnostics);
  if (tree) tree->text = std::move(text);
  return tree;
}

}  // namespace armloom
