#include "test/server/serve_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "server/recording/recording.h"

namespace armloom::test {
namespace {

constexpr int kPatience_ms = 20'000;

// Reads the port from the line "dashboard: http://127.0.0.1:PORT/".
std::uint16_t read_port(int fd) {
  std::string text;
  while (text.find('\n') == text.npos) {
    pollfd waiting{fd, POLLIN, 0};
    char bytes[256];
    if (poll(&waiting, 1, kPatience_ms) <= 0) throw std::runtime_error("the server says nothing");
    const ssize_t size = read(fd, bytes, sizeof bytes);
    if (size <= 0) throw std::runtime_error("the server has not come up");
    text.append(bytes, static_cast<std::size_t>(size));
  }
  return static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
}

}  // namespace

ServeProcess::ServeProcess(std::vector<std::string> arguments, const std::string& log,
                           const std::function<void()>& before)
    : log_(log) {
  int out[2];
  if (pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  arguments.insert(arguments.begin(), {ARMLOOM_BINARY, "serve", "--listen", "127.0.0.1:0"});
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    const int err = open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out[1], STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (before) before();
    execv(words.front(), words.data());
    _exit(127);
  }
  close(out[1]);
  port_ = read_port(out[0]);
  close(out[0]);
}

ServeProcess::~ServeProcess() {
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void ServeProcess::signal(int number) const { kill(pid_, number); }

int ServeProcess::wait() {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatience_ms);
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("it does not end");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string ServeProcess::log() const { return read_text_file(log_).value(); }

void set_limit(int resource, rlim_t value) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource>(resource), &limit);
  limit.rlim_cur = limit.rlim_max = value;
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

}  // namespace armloom::test
