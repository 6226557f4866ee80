#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/xml/xml_element.h"

namespace armloom {

// Folders in which a URDF's meshes are searched (mesh_path.h).
struct MeshFolders {
  std::filesystem::path urdf_folder;
  const std::map<std::string, std::string>* packages;
};

// urdfdom reads all or nothing, reports no places, and drops or guesses what it does not
// understand. So the URDF is checked first, and its valid parts are written into a second, mended
// <robot> for urdfdom (urdf_model.h). These notes contain facts about the URDF that the mended
// <robot> cannot express.
struct UrdfNotes {
  struct Joint {
    bool many_values = false;  // floating or planar: mended to fixed
    // True for each limit that the file gives. The mended <limit> also has placeholders, which
    // urdfdom requires.
    bool lower = false;
    bool upper = false;
    bool velocity = false;
    Diagnostics faults;  // of the limits; problems or warnings by the joint's role
  };
  std::map<std::string, Joint> joints;        // of the mended robot
  std::map<std::string, std::string> meshes;  // name in the file -> path
  std::set<std::string> seen;                 // links with a <visual>
  std::set<std::string> solid;                // links with a <collision>, which may be faulty
  std::set<std::string> loose;                // links without a parent because of a reported fault
  std::set<std::string> made;                 // links and joints added to form one tree
  bool patched = false;                       // see RobotTree
  bool nameless = false;                      // see RobotTree
  std::map<std::string, std::map<std::string, int>> lines;  // "link" or "joint" -> name -> line
};

// Checks every <link> and <joint>, and writes valid parts to `mended`. Faults in used parts (names,
// poses, axes, collision shapes, mimics) are problems. Faults in unused parts (visuals, masses,
// efforts, unknown elements) are warnings. Faults of limits go to UrdfNotes::Joint. Each place in a
// message begins with `file`.
[[nodiscard]] UrdfNotes check_urdf_elements(const tinyxml2::XMLElement& robot,
                                            const std::string& file, const MeshFolders& folders,
                                            tinyxml2::XMLElement& mended, Diagnostics& diagnostics);

// Checks one <link> (urdf_link_check.cc).
void check_link(const tinyxml2::XMLElement& link, const XmlPlace& place, const MeshFolders& folders,
                UrdfNotes& notes, tinyxml2::XMLElement& to);

// Checks that all links form one tree and that mimic joints follow a movable joint, directly or
// through other mimics. Repairs faults in `mended`, but keeps every name, so that names in other
// files can be looked up.
void check_urdf_tree(tinyxml2::XMLElement& mended, const std::string& file, UrdfNotes& notes,
                     Diagnostics& diagnostics);

}  // namespace armloom
