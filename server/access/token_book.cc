#include "server/access/token_book.h"

#include <sys/stat.h>

#include "server/access/digest.h"

namespace armloom {
namespace {

// Another one after every change: a file that is changed is a new one.
std::string stamp_of(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return "";
  return std::to_string(status.st_ino) + ' ' + std::to_string(status.st_size) + ' ' +
         std::to_string(status.st_mtim.tv_sec) + '.' + std::to_string(status.st_mtim.tv_nsec);
}

}  // namespace

void TokenBook::look() {
  std::string stamp = stamp_of(file_.file());
  if (!stamp.empty() && stamp == stamp_) return;
  tokens_.clear();
  if (auto read = file_.read()) tokens_ = std::move(*read);
  stamp_ = std::move(stamp);
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
