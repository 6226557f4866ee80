#include "server/access/token_book.h"

#include <sys/stat.h>

#include "server/access/digest.h"

namespace armloom {
namespace {

// Returns a text that changes whenever the file or its permissions change.
std::string stamp_of(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return "";
  return std::to_string(status.st_ino) + ' ' + std::to_string(status.st_size) + ' ' +
         std::to_string(status.st_mtim.tv_sec) + '.' + std::to_string(status.st_mtim.tv_nsec) +
         ' ' + std::to_string(status.st_ctim.tv_sec) + '.' + std::to_string(status.st_ctim.tv_nsec);
}

}  // namespace

void TokenBook::look() {
  std::string stamp = stamp_of(file_.file());
  if (stamp == stamp_) return;
  stamp_ = std::move(stamp);
  auto read = file_.read();
  if (read) {
    tokens_ = std::move(*read);
    return note(std::nullopt);
  }
  const Problem& problem = read.error().front();
  const bool is_gone = problem.kind == ProblemKind::not_found;
  if (is_gone) tokens_.clear();
  note(problem.detail + (is_gone ? ": no token is valid" : ": the previous tokens stay valid"));
}

void TokenBook::note(std::optional<std::string> fault) {
  fault_ = std::move(fault);
  if (fault_ && told_) told_(*fault_);
}

std::optional<std::string> TokenBook::fault() {
  look();
  return fault_;
}

std::optional<Caller> TokenBook::caller(std::string_view token) {
  look();
  const std::string digest = sha256_hex(token);
  std::optional<Caller> found;
  for (const KeptToken& kept : tokens_) {
    if (equal_in_constant_time(kept.digest, digest)) found = Caller{kept.name, kept.role};
  }
  return found;
}

}  // namespace armloom
