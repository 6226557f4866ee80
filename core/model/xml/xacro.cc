#include "core/model/xml/xacro.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>

#include "core/model/xml/text_file.h"

extern char** environ;

namespace armloom {
namespace {

class Pipe {
 public:
  Pipe() { open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] bool is_open() const { return open_; }
  [[nodiscard]] int read_end() const { return ends_[0]; }
  [[nodiscard]] int write_end() const { return ends_[1]; }
  void close_write_end() { close_end(1); }

 private:
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }

  std::array<int, 2> ends_{-1, -1};
  bool open_ = false;
};

struct Output {
  std::string out;
  std::string err;
  bool in_time = false;
};

// Returns false at the end of the stream or beyond kMaxRobotFileBytes.
bool read_some(int from, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t count = read(from, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 && text.size() <= kMaxRobotFileBytes;
}

Output read_both(const Pipe& out, const Pipe& err, std::chrono::seconds at_most) {
  Output output;
  const auto deadline = std::chrono::steady_clock::now() + at_most;
  std::array<pollfd, 2> open{pollfd{out.read_end(), POLLIN, 0}, pollfd{err.read_end(), POLLIN, 0}};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return output;
    if (poll(open.data(), open.size(), static_cast<int>(left.count())) < 0 && errno != EINTR)
      return output;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i].fd < 0 || open[i].revents == 0) continue;
      if (!read_some(open[i].fd, i == 0 ? output.out : output.err)) open[i].fd = -1;
      if (output.out.size() > kMaxRobotFileBytes) return output;
    }
  }
  output.in_time = true;
  return output;
}

// Starts xacro with its output connected to the pipes. Returns 0 or an error number (errno).
int start(const std::string& file, const Pipe& out, const Pipe& err, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end(), STDERR_FILENO);
  std::string program = "xacro";
  std::string argument = file;
  std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  const int error =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Keeps only the last line of a Python traceback.
std::string in_one_line(const std::string& text) {
  constexpr std::size_t kMost = 1000;
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    if (text.starts_with("Traceback")) all.clear();
    all += (all.empty() ? "" : "; ") + line.substr(begin);
  }
  if (all.size() > kMost) all.replace(kMost, std::string::npos, "...");
  return all;
}

}  // namespace

tl::expected<ExpandedXacro, std::string> expand_xacro(const std::filesystem::path& file,
                                                      std::chrono::seconds at_most) {
  const auto refuse = [](std::string why) { return tl::unexpected(std::move(why)); };
  // Use an absolute path, because xacro would read a name that begins with - as an option.
  const std::string path = std::filesystem::absolute(file).string();
  Pipe out;
  Pipe err;
  if (!out.is_open() || !err.is_open()) return refuse("no pipe could be opened");
  pid_t child = 0;
  const int error = start(path, out, err, child);
  if (error == ENOENT) {
    const std::string plain = (file.parent_path() / file.stem()).string();
    return refuse(
        "the program xacro is not installed; install it (pip install xacro), or expand the "
        "file elsewhere (xacro " +
        path + " > " + plain + ") and use the result");
  }
  if (error != 0) return refuse(std::string("xacro cannot be started: ") + std::strerror(error));
  out.close_write_end();
  err.close_write_end();
  Output output = read_both(out, err, at_most);
  const bool too_long = output.out.size() > kMaxRobotFileBytes;
  if (!output.in_time || too_long) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (too_long)
    return refuse("xacro printed more than " + std::to_string(kMaxRobotFileBytes) + " bytes");
  if (!output.in_time)
    return refuse("xacro took more than " + std::to_string(at_most.count()) + " s");
  std::string said = in_one_line(output.err);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return refuse(said.empty() ? "xacro failed without a message" : "xacro says: " + said);
  return ExpandedXacro{std::move(output.out), std::move(said)};
}

}  // namespace armloom
