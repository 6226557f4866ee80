#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace armloom::test {

// `armloom serve` as a child process; killed by the destructor.
class ServeProcess {
 public:
  // `before` runs in the child before exec, for example to set limits.
  ServeProcess(std::vector<std::string> arguments, const std::string& log,
               const std::function<void()>& before = {});
  ~ServeProcess();
  ServeProcess(const ServeProcess&) = delete;
  ServeProcess& operator=(const ServeProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }  // as printed by the server
  void signal(int number) const;
  // Returns the exit code, or -N after signal N; throws after 20 s.
  int wait();
  [[nodiscard]] std::string log() const;  // stderr so far

 private:
  pid_t pid_ = -1;
  std::string log_;
  std::uint16_t port_ = 0;
};

void set_limit(int resource, rlim_t value);

}  // namespace armloom::test
