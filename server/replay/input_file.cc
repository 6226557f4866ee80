#include "server/replay/input_file.h"

#include "server/codec/read_text.h"

namespace armloom {

Result<std::unique_ptr<InputFile>> InputFile::create(const std::filesystem::path& folder,
                                                     const InputLogHead& head, Parts parts) {
  std::unique_ptr<InputFile> log(new InputFile(std::move(parts)));
  const std::filesystem::path path = folder / kName;
  log->file_.open(path, std::ios::binary);
  log->file_ << text_of(*input_log_head_format(), head) << '\n' << std::flush;
  if (log->file_) return log;
  return failure(Problem{ProblemKind::unavailable, "cannot-write", "--data",
                         path.string() + " cannot be written", path.string()});
}

void InputFile::came(std::uint64_t ticks, const ExecutiveInput& input) {
  parts_.post([this, logged = std::make_shared<const LoggedInput>(LoggedInput{ticks, input})] {
    write(text_of(*logged_input_format(), *logged));
  });
}

// Writes nothing more after the first failure, because a log with a gap cannot be replayed.
void InputFile::write(const std::string& line) {
  if (said_lost_) return;
  file_ << line << '\n' << std::flush;
  if (file_) return;
  said_lost_ = true;
  if (parts_.alarm) parts_.alarm("the input log is incomplete: it cannot be written");
}

}  // namespace armloom
