#include "core/model/mesh_path.h"

#include <tinyxml2.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>

#include "core/model/mesh.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto differ = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return differ.first == folder.end() && differ.second != file.end();
}

}  // namespace

tl::expected<fs::path, std::string> resolve_mesh(
    const std::string& uri, const fs::path& urdf_folder,
    const std::map<std::string, std::string>& packages) {
  constexpr std::string_view kPackage = "package://";
  fs::path folder = urdf_folder;
  fs::path inside = uri;
  if (uri.starts_with(kPackage)) {
    const auto slash = uri.find('/', kPackage.size());
    const auto name = uri.substr(kPackage.size(), slash - kPackage.size());
    const auto package = packages.find(name);
    if (slash == std::string::npos)
      return tl::unexpected<std::string>("names no file in its package");
    if (package == packages.end()) {
      return tl::unexpected("is in package '" + name + "', which the cell's packages do not name");
    }
    folder = package->second;
    inside = uri.substr(slash + 1);
  } else if (uri.find("://") != std::string::npos || inside.is_absolute()) {
    return tl::unexpected<std::string>("is neither package:// nor relative to the URDF's folder");
  }
  if (folder.empty()) folder = ".";

  const fs::path lexical = inside.lexically_normal();
  if (inside.is_absolute() || lexical.empty() || *lexical.begin() == "..") {
    return tl::unexpected("leaves its folder " + folder.string());
  }
  std::error_code error;
  const fs::path real_folder = fs::canonical(folder, error);
  if (error) return tl::unexpected("lies in a folder that does not exist: " + folder.string());
  const fs::path real_file = fs::canonical(folder / lexical, error);
  if (error) return tl::unexpected("does not exist: " + (folder / lexical).string());
  if (!is_below(real_folder, real_file)) {
    return tl::unexpected("leaves its folder " + folder.string() + " through a link");
  }
  if (!fs::is_regular_file(real_file, error)) {
    return tl::unexpected("is not a regular file: " + real_file.string());
  }
  return real_file;
}

std::map<std::string, std::string> mesh_files(const std::string& urdf_text,
                                              const fs::path& urdf_folder,
                                              const std::map<std::string, std::string>& packages) {
  // Calls for each element in the document's order.
  struct MeshNames final : tinyxml2::XMLVisitor {
    std::set<std::string> names;
    bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute*) override {
      const char* name = element.Attribute("filename");
      if (std::string_view(element.Name()) == "mesh" && name != nullptr) names.insert(name);
      return true;
    }
  } found;
  tinyxml2::XMLDocument document;
  document.Parse(urdf_text.data(), urdf_text.size());
  document.Accept(&found);
  std::map<std::string, std::string> files;
  for (const std::string& name : found.names) {
    if (!is_mesh_name(name)) continue;
    if (const auto file = resolve_mesh(name, urdf_folder, packages))
      files.emplace(name, file->string());
  }
  return files;
}

}  // namespace armloom
