#include "server/recording/cell_copy.h"

#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "core/model/urdf/mesh_path.h"
#include "server/codec/cell_codec.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using Packages = std::map<std::string, std::string>;

constexpr const char* kFolder = "files";

class Copies {
 public:
  Copies(const fs::path& folder, const CellDescription& cell) : folder_(folder / kFolder) {
    for (const RobotDescription& robot : cell.robots)
      packages_[robot.urdf].insert(robot.packages.begin(), robot.packages.end());
  }

  // Returns the copy's name in the folder.
  std::string take(const fs::path& file) {
    const auto known = names_.find(file);
    if (known != names_.end()) return known->second;
    std::string name = unused_name(file);
    names_.emplace(file, name);
    const auto urdf = packages_.find(file.string());
    if (urdf != packages_.end()) {
      write_urdf(file, urdf->second, name);
    } else {
      copy(file, name);
    }
    return name;
  }

  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  std::string unused_name(const fs::path& file) {
    std::string name = file.filename().string();
    for (int n = 2; !taken_.insert(name).second; ++n)
      name = file.stem().string() + "-" + std::to_string(n) + file.extension().string();
    return name;
  }

  void write_urdf(const fs::path& file, const Packages& packages, const std::string& name) {
    const auto text = read_text_file(file);
    if (!text) return note(file, text.error().front().detail);
    Packages meshes = mesh_files(*text, file.parent_path(), packages);
    for (auto& [written, mesh] : meshes) mesh = take(mesh);
    make_folder();
    std::ofstream out(folder_ / name, std::ios::binary);
    out << with_mesh_names(*text, meshes) << std::flush;
    if (!out) note(folder_ / name, std::generic_category().message(errno));
  }

  void copy(const fs::path& file, const std::string& name) {
    make_folder();
    std::error_code error;
    if (fs::equivalent(file, folder_ / name, error)) return;  // the file is the copy itself
    fs::copy_file(file, folder_ / name, fs::copy_options::overwrite_existing, error);
    if (error) note(file, "to " + (folder_ / name).string() + ": " + error.message());
  }

  void make_folder() {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) note(folder_, error.message());
  }

  void note(const fs::path& file, const std::string& why) {
    if (fault_.empty()) fault_ = file.string() + ": " + why;
  }

  fs::path folder_;
  std::map<std::string, Packages> packages_;  // by URDF
  std::map<fs::path, std::string> names_;
  std::set<std::string> taken_;
  std::string fault_;
};

}  // namespace

Result<std::string> copy_cell(const CellFile& source, const fs::path& folder) {
  const auto cell = read_cell_text(source.text, source.file.parent_path());
  if (!cell) return failure(cell.error());
  Copies copies(folder, *cell);
  std::string text =
      with_cell_paths(source.text, source.file.parent_path(), [&](const fs::path& path) {
        // a package: only its used files are copied
        if (fs::is_directory(path)) return std::string(kFolder);
        if (!fs::exists(path)) return path.string();  // a schema, for editors only
        return kFolder + ("/" + copies.take(path));
      });
  if (!copies.fault().empty()) {
    return failure(Problem{ProblemKind::unavailable, "cannot-write", folder.string(),
                           "the cell's files cannot be copied: " + copies.fault(),
                           folder.string()});
  }
  return text;
}

}  // namespace armloom
