#include "core/model/urdf/mesh_path.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFile = "file://";
constexpr const char* kFileName = "filename";

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto differ = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return differ.first == folder.end() && differ.second != file.end();
}

// Decodes file:///path or file://localhost/path.
std::string path_of_file_uri(std::string_view uri) {
  uri.remove_prefix(kFile.size());
  if (uri.starts_with("localhost/")) uri.remove_prefix(std::string_view("localhost").size());
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += static_cast<char>(byte);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

// Returns the folder above "meshes" in the path or, if there is none, the mesh's own folder. Uses
// only the text of the path, because the folder must not be read.
fs::path package_folder_of(const fs::path& mesh) {
  fs::path above;
  for (const fs::path& part : mesh.parent_path()) {
    if (part == "meshes" && above.has_relative_path()) return above;
    above /= part;
  }
  return mesh.parent_path();
}

// Returns a hint if the folder contains a file whose name differs only in case.
std::string spelt_otherwise(const fs::path& file) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  const std::string wanted = lower(file.filename().string());
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (lower(name) == wanted) return "; did you mean " + name + "?";
  }
  return {};
}

std::string line_of_package(const std::string& name, const std::string& folder) {
  return "add to the robot \"packages\": {\"" + name + "\": \"" + folder + "\"}";
}

// Resolves an absolute path. If the path is outside of the permitted folders, the error does not
// reveal whether the file exists.
tl::expected<fs::path, std::string> resolve_absolute(
    const fs::path& file, const fs::path& urdf_folder,
    const std::map<std::string, std::string>& packages) {
  std::error_code error;
  if (!file.is_absolute()) return tl::unexpected<std::string>("names a file of another host");
  fs::path real_file = fs::weakly_canonical(file, error);
  if (error) real_file = file.lexically_normal();  // its symbolic links cannot be read
  const auto found = [&]() -> tl::expected<fs::path, std::string> {
    if (!fs::exists(real_file, error))
      return tl::unexpected("does not exist: " + real_file.string() + spelt_otherwise(real_file));
    if (!fs::is_regular_file(real_file, error))
      return tl::unexpected("is not a regular file: " + real_file.string());
    return real_file;
  };
  const auto holds = [&](const fs::path& folder) {
    const fs::path real_folder = fs::canonical(folder.empty() ? "." : folder, error);
    return !error && is_below(real_folder, real_file);
  };
  if (holds(urdf_folder)) return found();
  for (const auto& [name, folder] : packages) {
    if (holds(folder)) return found();
  }
  const fs::path package = package_folder_of(file.lexically_normal());
  return tl::unexpected(
      "lies neither below the URDF's folder nor below one of the cell's packages; " +
      line_of_package(package.filename().string(), package.string()));
}

std::vector<tinyxml2::XMLElement*> named_meshes(tinyxml2::XMLDocument& document) {
  struct Finder final : tinyxml2::XMLVisitor {
    std::vector<tinyxml2::XMLElement*> meshes;
    bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute*) override {
      const bool is_mesh = std::string_view(element.Name()) == "mesh";
      if (is_mesh && element.Attribute(kFileName) != nullptr)
        meshes.push_back(const_cast<tinyxml2::XMLElement*>(&element));
      return true;
    }
  } found;
  document.Accept(&found);
  return found.meshes;
}

// Looks for a folder of the package's name above the URDF, or next to a folder above it.
std::string likely_folder(const std::string& package, const fs::path& urdf_folder) {
  std::error_code error;
  const fs::path start = fs::canonical(urdf_folder.empty() ? "." : urdf_folder, error);
  for (fs::path folder = start; !error && folder.has_relative_path();
       folder = folder.parent_path()) {
    if (folder.filename() == package) return folder.string();
    if (fs::is_directory(folder / package, error)) return (folder / package).string();
  }
  return "<folder of " + package + ">";
}

}  // namespace

tl::expected<fs::path, std::string> resolve_mesh(
    const std::string& uri, const fs::path& urdf_folder,
    const std::map<std::string, std::string>& packages) {
  constexpr std::string_view kPackage = "package://";
  fs::path folder = urdf_folder;
  fs::path inside = uri;
  if (uri.starts_with(kFile)) return resolve_absolute(path_of_file_uri(uri), urdf_folder, packages);
  if (inside.is_absolute()) return resolve_absolute(inside, urdf_folder, packages);
  if (uri.starts_with(kPackage)) {
    const auto slash = uri.find('/', kPackage.size());
    const auto name = uri.substr(kPackage.size(), slash - kPackage.size());
    const auto package = packages.find(name);
    if (slash == std::string::npos)
      return tl::unexpected<std::string>("names no file in its package");
    if (package == packages.end()) {
      return tl::unexpected("is in package '" + name +
                            "', which the cell's packages do not name; " +
                            line_of_package(name, likely_folder(name, urdf_folder)));
    }
    folder = package->second;
    inside = uri.substr(slash + 1);
  } else if (uri.find("://") != std::string::npos) {
    return tl::unexpected<std::string>(
        "is neither package:// nor file:// nor a path from the URDF's folder; nothing is "
        "downloaded: save the file next to the URDF, and give its path");
  }
  if (folder.empty()) folder = ".";
  std::error_code error;

  const fs::path lexical = inside.lexically_normal();
  const bool leaves = !lexical.empty() && *lexical.begin() == "..";
  if (leaves && !uri.starts_with(kPackage)) {  // for example ../meshes, next to the urdf folder
    return resolve_absolute(fs::absolute(folder / lexical, error), urdf_folder, packages);
  }
  if (inside.is_absolute() || lexical.empty() || leaves) {
    return tl::unexpected("leaves its folder " + folder.string());
  }
  const fs::path real_folder = fs::canonical(folder, error);
  if (error) return tl::unexpected("lies in a folder that does not exist: " + folder.string());
  const fs::path real_file = fs::weakly_canonical(real_folder / lexical, error);
  if (error || !is_below(real_folder, real_file))
    return tl::unexpected("leaves its folder " + folder.string() + " through a symbolic link");
  if (!fs::exists(real_file, error))
    return tl::unexpected("does not exist: " + (folder / lexical).string() +
                          spelt_otherwise(folder / lexical));
  if (!fs::is_regular_file(real_file, error)) {
    return tl::unexpected("is not a regular file: " + real_file.string());
  }
  return real_file;
}

std::map<std::string, std::string> mesh_files(const std::string& urdf_text,
                                              const fs::path& urdf_folder,
                                              const std::map<std::string, std::string>& packages) {
  tinyxml2::XMLDocument document;
  document.Parse(urdf_text.data(), urdf_text.size());
  std::map<std::string, std::string> files;
  for (const tinyxml2::XMLElement* mesh : named_meshes(document)) {
    const std::string name = mesh->Attribute(kFileName);
    if (!is_mesh_name(name) || files.contains(name)) continue;
    if (const auto file = resolve_mesh(name, urdf_folder, packages))
      files.emplace(name, file->string());
  }
  return files;
}

std::string with_mesh_names(const std::string& urdf_text,
                            const std::map<std::string, std::string>& names) {
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf_text.data(), urdf_text.size()) != tinyxml2::XML_SUCCESS) return urdf_text;
  for (tinyxml2::XMLElement* mesh : named_meshes(document)) {
    const auto other = names.find(mesh->Attribute(kFileName));
    if (other != names.end()) mesh->SetAttribute(kFileName, other->second.c_str());
  }
  tinyxml2::XMLPrinter out;
  document.Print(&out);
  return out.CStr();
}

}  // namespace armloom
