#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/executive/link_watch.h"
#include "core/executive/modules.h"
#include "core/executive/state_watch.h"

namespace armloom {

// Runs the monitor on the measured state, watches the links of the arms, and acts on what it finds.
class ArmWatch : Modules {
 public:
  struct Calls {
    std::function<void(ArmId, const std::string& cause)> stop;
    std::function<void(ArmId)> resume;
  };
  ArmWatch(const Modules& modules, Calls calls);

  // Passes the report on to the scheduler. A motion that ended away from its goal has failed.
  void take(const MotionReport& report);
  // Runs in each control cycle, after the reports.
  void tick();
  // Tells the scheduler where an arm at rest really is, if that is not where it came to rest.
  void locate(ArmId arm);
  void resumed(ArmId arm) { watch_.resumed(arm); }
  void follow(ClearanceQuery& query) { watch_.follow(query, scene_.scene()); }

 private:
  void watch();
  void watch_links();
  void tell_unlocated(ArmId arm);
  void act_on(const std::vector<MonitorFinding>& found);

  Calls calls_;
  StateWatch watch_;
  LinkWatch links_;
};

}  // namespace armloom
