#pragma once

#include <functional>
#include <string>

#include "core/executive/real_time_loop.h"
#include "core/model/cell.h"
#include "server/api/cell_meshes.h"
#include "server/codec/wall_clock.h"
#include "server/http/router.h"
#include "server/hub/hub.h"
#include "server/recording/recording.h"

namespace armloom {

// The verbs under /api/v1: one member function each. Handlers run on the server's thread; what
// concerns the executive is posted to its strand and answered when it has come back, so that
// nothing here waits. All parts outlive the API.
class Api {
 public:
  struct Parts {
    CellPtr cell;
    std::string stream;
    std::string policy;  // in force
    WallClock clock;
    RealTimeLoop& loop;
    Hub& hub;
    Recording* recording;                             // null: none
    std::function<void(std::function<void()>)> post;  // to the server's thread, in order
  };
  explicit Api(Parts parts);

  void add_routes(Router& router);
  // A reader of the event stream: `?stream=&since=` resumes where it was, otherwise, and when those
  // events are gone ("gap"), it begins with a snapshot.
  void subscribe(const Target& target, std::function<void(FeedPtr)> then);

 private:
  using Arguments = Router::Arguments;
  void post_job(const Request& request, Respond respond);
  void list_jobs(const Request& request, Respond respond);
  void get_job(const std::string& key, Respond respond);
  void cancel_job(const std::string& key, Respond respond);
  void get_queue(Respond respond);
  void list_arms(Respond respond);
  void get_arm(const std::string& name, Respond respond);
  void stop(Respond respond);
  void resume(Respond respond);
  void ready(Respond respond);

  // Runs ask(executive) on the strand, then then(its answer) on the server's thread.
  template <class Ask, class Then>
  void ask(Ask ask, Then then);
  [[nodiscard]] std::string job_text(const JobView& job) const;

  Parts parts_;
  CellMeshes meshes_;
  std::string cell_text_;  // written once: a cell does not change while it runs
};

}  // namespace armloom
