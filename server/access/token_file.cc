#include "server/access/token_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/base/enumeration.h"
#include "server/access/digest.h"

namespace armloom {
namespace {

constexpr std::size_t kNameMax = 64;

bool is_name(const std::string& name) {
  const bool plain = std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
  return plain && !name.empty() && name.size() <= kNameMax;
}

bool is_digest(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == text.npos;
}

std::string now_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

tl::unexpected<Problems> cannot_write(const std::filesystem::path& file, int error) {
  return failure(
      Problem{ProblemKind::unavailable, "cannot-write", "--tokens",
              file.string() + " cannot be written: " + std::generic_category().message(error),
              file.string()});
}

// Gives the new file the owner and mode of the file `of`, which it replaces. Otherwise, after a
// change by root, the service's user could not read it.
bool takes_owner_and_mode(int fd, const std::filesystem::path& of) {
  struct stat kept {};
  if (stat(of.c_str(), &kept) != 0) return errno == ENOENT;
  return fchown(fd, kept.st_uid, kept.st_gid) == 0 && fchmod(fd, kept.st_mode & 0777U) == 0;
}

// While this object exists, other processes that want to change the file wait.
class Locked {
 public:
  explicit Locked(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    fd_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd_ >= 0) flock(fd_, LOCK_EX);
  }
  ~Locked() {
    if (fd_ >= 0) close(fd_);
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace

Result<std::vector<KeptToken>> TokenFile::read() const {
  std::ifstream in(file_);
  if (!in) {
    return failure(Problem{ProblemKind::not_found, "no-tokens", "--tokens",
                           file_.string() +
                               " cannot be read: " + std::generic_category().message(errno) +
                               "; create it with `armloom token add`",
                           file_.string()});
  }
  std::vector<KeptToken> tokens;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    KeptToken token;
    std::string role;
    words >> token.name >> role >> token.digest >> token.made_at;
    const auto known = value_named<Role>(role);
    if (!words || !is_name(token.name) || !known || !is_digest(token.digest)) {
      return failure(Problem{
          ProblemKind::invalid, "bad-token-file", "--tokens",
          file_.string() + ", line " + std::to_string(number) + " is not \"name role digest time\"",
          file_.string()});
    }
    token.role = *known;
    tokens.push_back(std::move(token));
  }
  if (in.bad()) {
    return failure(Problem{ProblemKind::invalid, "bad-token-file", "--tokens",
                           file_.string() + " cannot be read: it is not a text file",
                           file_.string()});
  }
  return tokens;
}

Result<void> TokenFile::write(const std::vector<KeptToken>& tokens) const {
  std::string text =
      "# Tokens of armloom serve: name, role, SHA-256 of the token, when it was made.\n";
  for (const KeptToken& token : tokens) {
    text +=
        token.name + ' ' + to_string(token.role) + ' ' + token.digest + ' ' + token.made_at + '\n';
  }
  const std::string next = file_.string() + ".new";
  const int fd = open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) return cannot_write(file_, errno);
  const ssize_t size = ::write(fd, text.data(), text.size());
  const bool written = size == static_cast<ssize_t>(text.size()) &&
                       takes_owner_and_mode(fd, file_) && fsync(fd) == 0;
  const int error = size >= 0 && !written && errno == 0 ? ENOSPC : errno;
  close(fd);
  if (!written) {
    unlink(next.c_str());
    return cannot_write(file_, error);
  }
  if (rename(next.c_str(), file_.c_str()) != 0) return cannot_write(file_, errno);
  return {};
}

Result<std::string> TokenFile::add(const std::string& name, Role role) {
  if (!is_name(name)) {
    return failure(Problem{ProblemKind::invalid, "bad-name", "--name",
                           "a name is 1 to 64 characters of A-Z a-z 0-9 . _ -", name});
  }
  const Locked locked(file_);
  std::vector<KeptToken> tokens;
  if (std::error_code ec; std::filesystem::exists(file_, ec)) {
    auto kept = read();
    if (!kept) return failure(std::move(kept.error()));
    tokens = std::move(*kept);
  }
  if (std::ranges::find(tokens, name, &KeptToken::name) != tokens.end()) {
    return failure(Problem{ProblemKind::conflict, "name-in-use", "--name",
                           "there is a token of \"" + name + "\" already; revoke it first", name});
  }
  std::string token = "armloom_" + random_hex();
  tokens.push_back({name, role, sha256_hex(token), now_text()});
  if (auto written = write(tokens); !written) return failure(std::move(written.error()));
  return token;
}

Result<void> TokenFile::revoke(const std::string& name) {
  const Locked locked(file_);
  auto tokens = read();
  if (!tokens) return failure(std::move(tokens.error()));
  if (std::erase_if(*tokens, [&](const KeptToken& token) { return token.name == name; }) == 0) {
    return failure(Problem{ProblemKind::not_found, "no-such-token", "--name",
                           "no token has the name \"" + name + "\"", name});
  }
  return write(*tokens);
}

}  // namespace armloom
