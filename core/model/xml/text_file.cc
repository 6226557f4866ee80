#include "core/model/xml/text_file.h"

#include <fstream>
#include <system_error>

namespace armloom {

Result<std::string> read_text_file(const std::filesystem::path& path, const std::string& pointer,
                                   const std::string& whose) {
  const auto refuse = [&](ProblemKind kind, std::string slug, const std::string& why) {
    return failure(Problem{kind, std::move(slug), pointer,
                           whose + ": cannot read " + path.string() + ": " + why, path.string()});
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return refuse(ProblemKind::not_found, "file-missing", "there is no such file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return refuse(ProblemKind::invalid, "file-unreadable", "it is not a regular file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return refuse(ProblemKind::invalid, "file-unreadable", "it cannot be opened");

  // Read one byte more than the size, to detect a file that grows meanwhile.
  const auto size = std::filesystem::file_size(path, error);
  const bool bounded = !error && size < kMaxRobotFileBytes;
  std::string text((bounded ? static_cast<std::size_t>(size) : kMaxRobotFileBytes) + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) return refuse(ProblemKind::invalid, "file-unreadable", "reading failed");
  text.resize(static_cast<std::size_t>(stream.gcount()));

  if (text.size() > kMaxRobotFileBytes) {
    return refuse(ProblemKind::too_large, "file-too-large",
                  "it is longer than " + std::to_string(kMaxRobotFileBytes) + " bytes");
  }
  if (text.find('\0') != std::string::npos) {
    return refuse(ProblemKind::malformed, "xml-malformed", "it holds a zero byte");
  }
  return text;
}

}  // namespace armloom
