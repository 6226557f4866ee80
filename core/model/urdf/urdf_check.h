#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/xml/xml_element.h"

namespace armloom {

// Where a URDF's meshes are looked for (mesh_path.h).
struct MeshFolders {
  std::filesystem::path urdf_folder;
  const std::map<std::string, std::string>* packages;
};

// urdfdom reads a URDF all or nothing, names no places, and drops or guesses what it does not
// understand. So the URDF is checked first, and what is right is written into a second, mended
// <robot>, which urdfdom then reads (urdf_model.h). These notes are what that cannot say.
struct UrdfNotes {
  struct Joint {
    bool many_values = false;  // floating or planar: mended to fixed
    // Which limits the file gives. Else the mended <limit> is only the form that urdfdom asks for.
    bool lower = false;
    bool upper = false;
    bool velocity = false;
    Diagnostics faults;  // of the limits: who needs them decides what follows
  };
  std::map<std::string, Joint> joints;        // each of the mended robot
  std::map<std::string, std::string> meshes;  // name in the file -> path
  std::set<std::string> seen;                 // links with a <visual>
  std::set<std::string> solid;                // links with a <collision>, which may be faulty
  std::set<std::string> loose;                // links that hang on nothing because of what was told
  std::set<std::string> made;  // links and joints that only make the mended robot one tree
  bool patched = false;        // as RobotTree has it
  bool nameless = false;       // the same
  std::map<std::string, std::map<std::string, int>> lines;  // "link", "joint": name -> line
};

// Checks every <link> and <joint>, tells all that is wrong and writes what is right to `mended`.
// What the model is made of must be right: names, poses, axes, collision shapes, mimics; each
// number finite and complete, nothing doubled, missing or misspelt. What it does not use (visuals,
// masses, efforts, unknown elements) only warns, and limits are judged by whose joint it is. `file`
// begins each place.
[[nodiscard]] UrdfNotes check_urdf_elements(const tinyxml2::XMLElement& robot,
                                            const std::string& file, const MeshFolders& folders,
                                            tinyxml2::XMLElement& mended, Diagnostics& diagnostics);

// One <link> of these (urdf_link_check.cc).
void check_link(const tinyxml2::XMLElement& link, const XmlPlace& place, const MeshFolders& folders,
                UrdfNotes& notes, tinyxml2::XMLElement& to);

// Joints must connect known links, all links hang in one tree under one root, and a mimic joint
// follow a movable joint, through other mimics or not. Where that is not so it is told, and
// `mended` is patched: every name of the file that occurs is in it, so that other files' names can
// still be looked up.
void check_urdf_tree(tinyxml2::XMLElement& mended, const std::string& file, UrdfNotes& notes,
                     Diagnostics& diagnostics);

}  // namespace armloom
