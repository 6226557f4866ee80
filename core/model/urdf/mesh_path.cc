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
constexpr std::string_view kPackage = "package://";
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

// Returns the package and path of a mesh at an absolute path (package_of_mesh). Uses only the text
// of the path, because other folders must not be read.
std::optional<PackagePath> package_in_path(const fs::path& mesh,
                                           const std::map<std::string, std::string>& packages) {
  const fs::path path = mesh.lexically_normal();
  std::optional<PackagePath> known;
  std::optional<PackagePath> above_meshes;
  fs::path folder = path.root_path();
  for (const fs::path& part : path.parent_path().relative_path()) {
    if (part == "meshes" && !above_meshes && folder.has_relative_path())
      above_meshes = {folder.filename(), path.lexically_relative(folder), folder};
    folder /= part;
    if (packages.contains(part.string()))
      known = {part.string(), path.lexically_relative(folder), folder};
  }
  if (known) return known;
  if (above_meshes) return above_meshes;
  if (!folder.has_relative_path()) return std::nullopt;
  return PackagePath{folder.filename(), path.filename(), folder};
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

// Looks for a folder of the package's name above the URDF, or next to a folder above it.
std::optional<std::string> likely_folder(const std::string& package, const fs::path& urdf_folder) {
  std::error_code error;
  const fs::path start = fs::canonical(urdf_folder.empty() ? "." : urdf_folder, error);
  if (error) return std::nullopt;
  for (fs::path folder = start; folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() == package) return folder.string();
    if (fs::is_directory(folder / package, error)) return (folder / package).string();
  }
  return std::nullopt;
}

// Returns the line of the cell file that permits a mesh, with the package's folder if it exists.
std::string line_of_package(const PackagePath& mesh, const fs::path& urdf_folder) {
  std::error_code error;
  std::optional<std::string> folder;
  if (!mesh.folder.empty() && fs::is_directory(mesh.folder, error))
    folder = mesh.folder.string();
  else
    folder = likely_folder(mesh.package, urdf_folder);
  const std::string line = "add to the robot \"packages\": {\"" + mesh.package + "\": \"";
  if (folder) return line + *folder + "\"}";
  return line + "FOLDER\"} with the folder on this machine that contains " + mesh.inside.string();
}

tl::expected<fs::path, std::string> existing_file(const fs::path& real_file) {
  std::error_code error;
  if (!fs::exists(real_file, error))
    return tl::unexpected("does not exist: " + real_file.string() + spelt_otherwise(real_file));
  if (!fs::is_regular_file(real_file, error))
    return tl::unexpected("is not a regular file: " + real_file.string());
  return real_file;
}

// Resolves a relative path that must stay in its folder.
tl::expected<fs::path, std::string> resolve_inside(const fs::path& folder, const fs::path& inside) {
  std::error_code error;
  const fs::path lexical = inside.lexically_normal();
  if (inside.is_absolute() || lexical.empty() || *lexical.begin() == "..")
    return tl::unexpected("leaves its folder " + folder.string());
  const fs::path real_folder = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return tl::unexpected("lies in a folder that does not exist: " + folder.string());
  const fs::path real_file = fs::weakly_canonical(real_folder / lexical, error);
  if (error || !is_below(real_folder, real_file))
    return tl::unexpected("leaves its folder " + folder.string() + " through a symbolic link");
  if (!fs::exists(real_file, error)) {
    return tl::unexpected("does not exist: " + (folder / lexical).string() +
                          spelt_otherwise(folder / lexical));
  }
  return existing_file(real_file);
}

// Resolves an absolute path. If the path is outside of the permitted folders, the error does not
// reveal whether the file exists.
tl::expected<fs::path, std::string> resolve_absolute(
    const fs::path& file, const fs::path& urdf_folder,
    const std::map<std::string, std::string>& packages) {
  std::error_code error;
  if (!file.is_absolute()) {
    return tl::unexpected("names a file of another host, " + file.begin()->string() +
                          ": write a path of this machine with three slashes (file:///home/...)");
  }
  fs::path real_file = fs::weakly_canonical(file, error);
  if (error) real_file = file.lexically_normal();  // its symbolic links cannot be read
  const auto holds = [&](const fs::path& folder) {
    const fs::path real_folder = fs::canonical(folder.empty() ? "." : folder, error);
    return !error && is_below(real_folder, real_file);
  };
  bool is_permitted = holds(urdf_folder);
  for (const auto& [name, folder] : packages) is_permitted = is_permitted || holds(folder);
  if (is_permitted && fs::exists(real_file, error)) return existing_file(real_file);

  const auto mesh = package_in_path(file, packages);
  if (mesh) {
    const auto package = packages.find(mesh->package);
    if (package != packages.end()) return resolve_inside(package->second, mesh->inside);
  }
  if (is_permitted) return existing_file(real_file);
  const std::string why =
      "lies neither below the URDF's folder nor below one of the cell's packages";
  return tl::unexpected(mesh ? why + "; " + line_of_package(*mesh, urdf_folder) : why);
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

// Returns the package in package://name/rest, or nullopt if a part is missing. A repeated slash
// (package://name//rest) counts once, as in ROS.
std::optional<PackagePath> package_in_uri(std::string_view uri) {
  uri.remove_prefix(kPackage.size());
  const std::size_t slash = uri.find('/');
  if (slash == 0 || slash == uri.npos) return std::nullopt;
  const std::size_t begin = uri.find_first_not_of('/', slash);
  if (begin == uri.npos) return std::nullopt;
  return PackagePath{std::string(uri.substr(0, slash)), fs::path(uri.substr(begin)), {}};
}

}  // namespace

tl::expected<fs::path, std::string> resolve_mesh(
    const std::string& uri, const fs::path& urdf_folder,
    const std::map<std::string, std::string>& packages) {
  if (uri.starts_with(kFile)) return resolve_absolute(path_of_file_uri(uri), urdf_folder, packages);
  if (uri.starts_with(kPackage)) {
    const auto mesh = package_in_uri(uri);
    if (!mesh) return tl::unexpected<std::string>("names no file in its package");
    const auto package = packages.find(mesh->package);
    if (package != packages.end()) return resolve_inside(package->second, mesh->inside);
    return tl::unexpected("is in package '" + mesh->package +
                          "', which the cell's packages do not name; " +
                          line_of_package(*mesh, urdf_folder));
  }
  if (uri.find("://") != std::string::npos) {
    return tl::unexpected<std::string>(
        "is neither package:// nor file:// nor a path from the URDF's folder; nothing is "
        "downloaded: save the file next to the URDF, and give its path");
  }
  const fs::path path = uri;
  if (path.is_absolute()) return resolve_absolute(path, urdf_folder, packages);
  const fs::path folder = urdf_folder.empty() ? "." : urdf_folder;
  const fs::path lexical = path.lexically_normal();
  if (!lexical.empty() && *lexical.begin() == "..") {  // ../meshes, next to the URDF's folder
    std::error_code error;
    return resolve_absolute(fs::absolute(folder / lexical, error), urdf_folder, packages);
  }
  return resolve_inside(folder, path);
}

std::optional<PackagePath> package_of_mesh(const std::string& uri, const fs::path& urdf_folder,
                                           const std::map<std::string, std::string>& packages) {
  if (uri.starts_with(kPackage)) return package_in_uri(uri);
  if (uri.starts_with(kFile)) {
    const fs::path path = path_of_file_uri(uri);
    return path.is_absolute() ? package_in_path(path, packages) : std::nullopt;
  }
  if (uri.find("://") != std::string::npos) return std::nullopt;
  std::error_code error;
  return package_in_path(fs::absolute(urdf_folder / uri, error), packages);
}

std::set<std::string> mesh_names(const std::string& urdf_text) {
  tinyxml2::XMLDocument document;
  document.Parse(urdf_text.data(), urdf_text.size());
  std::set<std::string> names;
  for (const tinyxml2::XMLElement* mesh : named_meshes(document))
    names.insert(mesh->Attribute(kFileName));
  return names;
}

std::map<std::string, std::string> mesh_files(const std::string& urdf_text,
                                              const fs::path& urdf_folder,
                                              const std::map<std::string, std::string>& packages) {
  std::map<std::string, std::string> files;
  for (const std::string& name : mesh_names(urdf_text)) {
    if (!is_mesh_name(name)) continue;
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
