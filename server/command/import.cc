#include <fstream>
#include <iostream>
#include <system_error>

#include "server/command/command.h"
#include "server/command/progress.h"
#include "server/import/import_cell.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

Problem at_option(std::string option, std::string why) {
  return {ProblemKind::invalid, "bad-option", std::move(option), std::move(why), {}};
}

void check_number(const std::string& option, std::size_t given, std::size_t urdfs,
                  Problems& problems) {
  if (given == urdfs) return;
  problems.push_back(at_option(option, std::to_string(urdfs) + " --urdf but " +
                                           std::to_string(given) + " " + option + ": give one " +
                                           option + " for each --urdf, in the same order"));
}

// Checks an option that may be given once for all --urdf, or once for each.
void check_number_or_one(const std::string& option, std::size_t given, std::size_t urdfs,
                         Problems& problems) {
  if (given > 1) check_number(option, given, urdfs, problems);
}

std::string at_or_only(const std::vector<std::string>& values, std::size_t i) {
  return values.empty() ? "" : values.size() == 1 ? values.front() : values[i];
}

Result<ImportRequest> request_of(const ImportOptions& options) {
  Problems problems;
  ImportRequest request{.cell = options.name, .prefix = options.prefix};
  check_number("--srdf", options.srdf.size(), options.urdf.size(), problems);
  if (!options.joint_limits.empty()) {
    check_number("--joint-limits", options.joint_limits.size(), options.urdf.size(), problems);
  }
  check_number_or_one("--srdf-prefix", options.srdf_prefixes.size(), options.urdf.size(), problems);
  check_number_or_one("--joint-limits-prefix", options.joint_limits_prefixes.size(),
                      options.urdf.size(), problems);
  for (const std::string& text : options.robots) {
    auto robot = read_placement(text);
    if (robot) {
      request.robots.push_back(*std::move(robot));
    } else {
      problems.insert(problems.end(), robot.error().begin(), robot.error().end());
    }
  }
  for (const std::string& text : options.packages) {
    const std::size_t equals = text.find('=');
    const fs::path folder = equals == text.npos ? "" : text.substr(equals + 1);
    std::error_code error;
    if (equals == 0 || equals == text.npos) {
      problems.push_back(at_option("--package", "in \"" + text + "\": expected NAME=FOLDER"));
    } else if (!fs::is_directory(folder, error)) {
      problems.push_back(at_option("--package", "in \"" + text + "\": no such folder"));
    } else {
      request.packages[text.substr(0, equals)] = folder.string();
    }
  }
  if (!problems.empty()) return failure(std::move(problems));
  for (std::size_t i = 0; i < options.urdf.size(); ++i) {
    request.files.push_back({options.urdf[i], options.srdf[i],
                             options.joint_limits.empty() ? "" : options.joint_limits[i],
                             at_or_only(options.srdf_prefixes, i),
                             at_or_only(options.joint_limits_prefixes, i)});
  }
  if (!options.out.empty()) {
    const fs::path out = fs::absolute(options.out);
    request.folder = out.parent_path();
    if (request.cell.empty()) request.cell = out.stem().string();
  }
  return request;
}

// Writes a new file. Never overwrites an existing file, because it may have manual changes.
bool write_new(const fs::path& file, const std::string& text) {
  std::error_code error;
  if (fs::exists(file, error)) {
    complain("", {at_option("--out",
                            file.string() + " already exists: remove it, or give another file")});
    return false;
  }
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) complain("", {at_option("--out", file.string() + " cannot be written")});
  return stream.good();
}

}  // namespace

int import_robots(const ImportOptions& options) {
  const auto request = request_of(options);
  if (!request) return refuse("", request.error());
  const Detail detail = options.verbose ? Detail::all : Detail::one_of_each_kind;
  const auto imported = [&] {
    const Progress progress("import");
    return import_cell(*request);
  }();
  if (!imported) return refuse("", imported.error(), detail);
  if (options.out.empty()) {
    std::cout << imported->text << std::flush;
  } else if (!write_new(options.out, imported->text)) {
    return kExitBadInput;
  }
  const std::string file = options.out.empty() ? "stdout" : options.out;
  for (const std::string& remark : imported->remarks) {
    std::cerr << "armloom: note: " << file << ":" << remark << '\n';
  }
  const auto loaded = load_cell_text(imported->text, file, detail);
  return loaded && is_fit_to_run(*loaded, detail) ? kExitDone : kExitBadInput;
}

}  // namespace armloom
