#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace armloom::test {

// `armloom serve` as a process of its own, as an engineer starts it. Killed at the end.
class ServeProcess {
 public:
  // `before`: runs in the child, before it becomes the server: its limits.
  ServeProcess(std::vector<std::string> arguments, const std::string& log,
               const std::function<void()>& before = {});
  ~ServeProcess();
  ServeProcess(const ServeProcess&) = delete;
  ServeProcess& operator=(const ServeProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }  // as it says it
  void signal(int number) const;
  // Its exit code, -N when signal N has ended it; waits for that at most 20 s.
  int wait();
  [[nodiscard]] std::string log() const;  // what it said on stderr

 private:
  pid_t pid_ = -1;
  std::string log_;
  std::uint16_t port_ = 0;
};

void set_limit(int resource, rlim_t value);

}  // namespace armloom::test
