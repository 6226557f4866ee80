#include "core/executive/thread_priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace armloom {
namespace {

constexpr int kFirst = -10;
constexpr int kNicest = 19;

void set_niceness(int niceness) {
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
}

}  // namespace

void go_first() { set_niceness(kFirst); }
void give_way() { set_niceness(kNicest); }

}  // namespace armloom
