#include "server/service/service.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

#include "core/executive/real_time_loop.h"
#include "core/executive/worker.h"
#include "server/api/answer_form.h"
#include "server/api/api.h"
#include "server/api/listings.h"
#include "server/codec/stream_id.h"
#include "server/comparison/comparison.h"
#include "server/control/control.h"
#include "server/drivers/io_devices.h"
#include "server/drivers/remote_controller.h"
#include "server/durable/damage.h"
#include "server/durable/request_trail.h"
#include "server/durable/restart.h"
#include "server/http/http_server.h"
#include "server/http/static_files.h"
#include "server/hub/broadcast.h"
#include "server/replay/input_file.h"
#include "server/replay/reported_arms.h"

namespace armloom {

class Service::Impl {
 public:
  explicit Impl(ServiceOptions options)
      : options_(std::move(options)),
        files_(options_.web, refusal_response),
        guard_(options_.tokens, options_.tls.has_value(),
               [this](const std::string& what) { alarm(what); }),
        limits_(options_.limits) {
    if (!options_.log) options_.log = [](const LogLine&) {};
  }

  std::optional<Problems> start(const CellPtr& cell, const CellFile& source) {
    auto http = HttpServer::listen(options_.address, options_.port, options_.connections_max);
    if (!http) return std::move(http.error());
    http_ = std::move(*http);
    if (options_.tls) {
      if (auto used = http_->use_tls(*options_.tls); !used) return std::move(used.error());
    }
    metrics_ = std::make_unique<Metrics>(cell, options_.speed);
    if (options_.data) {
      if (auto problems = open_store(*options_.data)) return problems;
      auto recording = Recording::create(Recording::unused_folder(*options_.data), source, *cell,
                                         options_.record_states);
      if (!recording) return std::move(recording.error());
      recording_ = std::move(*recording);
    }
    trail_.emplace(keeper_.get(), options_.log, options_.logged_requests);
    router_.watch([this](const std::string& method, const std::string& route, int status,
                         std::chrono::nanoseconds after) {
      metrics_->answered(method, route, status, after);
    });
    router_.guard(
        [this](const Request& request, Role role) { return guard_.refusal(request, role); });
    router_.limit([this](const Request& request) { return one_too_many(request); });
    clock_.emplace(std::chrono::system_clock::now(), options_.speed);
    const auto post = [http_server = http_.get()](std::function<void()> task) {
      http_server->post(std::move(task));
    };
    const auto post_urgent = [http_server = http_.get()](std::function<void()> task) {
      http_server->post_urgent(std::move(task));
    };
    alerts_ = std::make_unique<AlertBook>(stream_, *clock_, keeper_.get());
    broadcast_ = std::make_unique<Broadcast>(Broadcast::Parts{
        cell, stream_, *clock_, hub_, states_, recording_.get(), keeper_.get(), *alerts_, post,
        post_urgent, options_.log, [this](Alert alert) { tell(std::move(alert)); }, *metrics_});
    ExecutiveOptions executive_options{.policy = options_.policy};
    std::optional<Restart> restart;
    if (keeper_) {
      keeper_->serve(*clock_, post);
      auto prepared = Restart::prepare(*keeper_);
      if (!prepared) return std::move(prepared.error());
      restart = std::move(*prepared);
      executive_options.starts = keeper_.get();
      executive_options.first_job = JobId{keeper_->store().leftover().last_number + 1};
    }
    if (auto problems = log_inputs(cell, executive_options, post)) return problems;
    ControllerTypes remote = remote_controllers(stream_);
    if (inputs_) remote = recorded(std::move(remote), *inputs_);
    remote.merge(faults_.watched(simulated_controllers()));
    executive_options.controllers = std::move(remote);
    io_ = std::make_unique<IoDevices>(cell);
    executive_options.write_signal = [this](SignalId signal, const SignalValue& value) {
      io_->write(signal, value);
    };
    auto loop =
        RealTimeLoop::start(cell, std::move(executive_options), options_.speed, *broadcast_);
    if (!loop) return std::move(loop.error());
    loop_ = std::move(*loop);
    io_->start([this](IoReport report) {
      loop_->post_urgent([report = std::move(report)](Executive& executive) {
        executive.signals().report(report);
      });
    });
    if (restart) go_on(std::move(*restart), cell);
    keep_recordings(source.file.parent_path());
    comparison_ = std::make_unique<Comparison>(cell, post);
    listings_ = std::make_unique<Listings>(post);
    const auto aside = [this](std::function<void()> task) { worker_.post(std::move(task)); };
    api_ = std::make_unique<Api>(ApiParts{cell,
                                          stream_,
                                          *clock_,
                                          *loop_,
                                          hub_,
                                          states_,
                                          recording_.get(),
                                          keeper_.get(),
                                          *alerts_,
                                          post,
                                          post_urgent,
                                          guard_,
                                          aside,
                                          *listings_,
                                          *metrics_,
                                          limits_,
                                          *comparison_,
                                          control_,
                                          faults_,
                                          options_.data,
                                          options_.jog_lease});
    api_->add_routes(router_);
    router_.otherwise([this](const Request& request) { return answer_file(request); });
    return std::nullopt;
  }

  void run(bool until_signal) {
    Site site;
    site.handle = [this](const Request& request, Respond respond) {
      respond = in_asked_form(
          request, std::move(respond),
          [this](std::function<void()> task) { forming_.post(std::move(task)); },
          [this](std::function<void()> task) { http_->post(std::move(task)); });
      router_.dispatch(request, noting(request, std::move(respond)));
    };
    site.refuse_unread = [this](const Request& request) {
      auto refused = router_.refuse_unread(request);
      if (refused) noting(request, [](const Response&) {})(*refused);
      return refused;
    };
    site.refuse = refusal_response;
    site.is_stop = [this](const Request& request) { return router_.is_stop(request); };
    const bool everywhere = options_.address == "0.0.0.0" || options_.address == "::";
    site.hosts = HostRule{options_.allowed_hosts, options_.allowed_origins, everywhere,
                          options_.tls.has_value()};
    site.keep_alive = options_.keep_alive;
    site.send_time = options_.send_time;
    site.send_buffer = options_.send_buffer;
    site.memory_max = options_.memory_max;
    site.read_time = options_.read_time;
    site.connections_per_client_max = options_.connections_per_client_max;
    site.on_limited_connection = [this] { metrics_->limited("connections"); };
    site.wind_down = [this](std::function<void()> done) {
      const auto waiting = keeper_ ? Executive::Waiting::is_kept : Executive::Waiting::ends;
      loop_->post_urgent([waiting, done = std::move(done)](Executive& executive) {
        executive.wind_down("the server ends", waiting, done);
      });
    };
    site.end = [this] { hub_.end(); };
    http_->run(std::move(site), until_signal);
  }

  ~Impl() { (void)close(); }

  // Closes the store first, because it posts write completions to the loop. So do the I/O devices.
  std::optional<std::string> close() {
    const auto fault = keeper_ ? keeper_->store().close() : std::nullopt;
    if (io_) io_->end();
    loop_.reset();
    if (recording_) recording_->close();
    if (fault) return "jobs cannot be stored: " + fault->text;
    return recording_ ? recording_->fault() : std::nullopt;
  }

  HttpServer& http() { return *http_; }
  std::optional<std::filesystem::path> recorded_to() const {
    return recording_ ? std::optional(recording_->folder()) : std::nullopt;
  }

 private:
  std::optional<Problems> open_store(const std::filesystem::path& folder) {
    StoreOptions store_options = options_.store;
    store_options.on_fault = [this](const StoreFault* fault) { store_fails(fault); };
    store_options.on_written = [this](std::chrono::nanoseconds within) {
      metrics_->stored(within);
    };
    auto keeper = JobKeeper::open(folder, std::move(store_options));
    if (!keeper) return std::move(keeper.error());
    keeper_ = std::move(*keeper);
    return std::nullopt;
  }

  // Records the executive's inputs next to the events.
  std::optional<Problems> log_inputs(const CellPtr& cell, ExecutiveOptions& options,
                                     const std::function<void(std::function<void()>)>& post) {
    if (!recording_) return std::nullopt;
    const std::string& policy = options.policy.empty() ? cell->scheduling.policy : options.policy;
    auto inputs =
        InputFile::create(recording_->folder(), {policy, options.seed, options.first_job.value()},
                          {post, [this](const std::string& what) {
                             tell({Alert::Level::error, what});
                           }});
    if (!inputs) return std::move(inputs.error());
    inputs_ = std::move(*inputs);
    options.inputs = inputs_.get();
    return std::nullopt;
  }

  // Called on the store's thread if writing fails, and with null when it works again. After a
  // failure, stops all arms, because an arm may start only if the start can be stored.
  void store_fails(const StoreFault* fault) {
    const std::string text = fault != nullptr
                                 ? "jobs cannot be stored: " + fault->text
                                 : "jobs can be stored again; arms stay stopped until resumed";
    alarm(text);
    if (fault == nullptr || !loop_is_there_) return;
    loop_->post_urgent([text](Executive& executive) { stop_all(executive, text); });
  }

  void go_on(Restart restart, const CellPtr& cell) {
    keeper_->runs_on(*loop_);
    loop_is_there_ = true;
    look_for_damage();
    // Waits, so that clients do not see the cell before the previous session is restored.
    std::promise<void> restored;
    loop_->post_urgent([&](Executive& executive) {
      restart.go_on(executive, *cell, *keeper_);
      restored.set_value();
    });
    restored.get_future().wait();
  }

  // Raises the alert on the executive, in order with the executive's own alerts.
  void tell(Alert alert) {
    loop_->post([alert = std::move(alert)](Executive& executive) { executive.alert(alert); });
  }

  // Searches the store for damage, on the worker: with 100,000 jobs, this takes a tenth of a
  // second.
  void look_for_damage() {
    worker_.post([this] {
      const auto damage = keeper_->lists().damage();
      if (damage && !damage->is_none()) tell(alert_of(*damage));
    });
  }

  void alarm(const std::string& what) { options_.log({LogLine::Level::error, what}); }

  void keep_recordings(const std::filesystem::path& cell_folder) {
    if (!recording_ || !options_.kept_recordings.is_any()) return;
    constexpr std::chrono::minutes kPeriod{1};
    const auto tell = [log = options_.log](const RemovedRecording& gone) {
      const bool whole = gone.fault.empty();
      LogLine line{
          whole ? LogLine::Level::info : LogLine::Level::error,
          whole ? "an old recording was removed" : "an old recording cannot be removed",
          {{"folder", gone.folder.string()}, {"bytes", static_cast<std::int64_t>(gone.bytes)}}};
      if (!whole) line.fields.emplace_back("fault", gone.fault);
      log(line);
    };
    old_recordings_.emplace(
        OldRecordings::Place{*options_.data, {recording_->folder(), cell_folder}},
        options_.kept_recordings, kPeriod, tell);
  }

  Respond noting(const Request& request, Respond respond) {
    const auto caller = guard_.caller(request.token);
    return trail_->follow(request, caller ? caller->name : std::string(), std::move(respond));
  }

  std::optional<Refusal> one_too_many(const Request& request) {
    const auto now = std::chrono::steady_clock::now();
    auto refusal = limits_.request(guard_.client(request), now);
    if (refusal) metrics_->limited("requests");
    return refusal;
  }

  Response answer_file(const Request& request) {
    if (request.target.path == "/" && !guard_.caller(request.token)) {
      // Relative, because a reverse proxy may serve the page below a path.
      return Response{303, "", "", {{"Location", "login"}, {"Cache-Control", "no-store"}}};
    }
    if (!request.target.path.starts_with("/api/")) return files_.answer(request);
    return refusal_response({404, "not-found", "nothing is served at " + request.target.path,
                             "request target", request.target.path});
  }

  // Destroyed from the bottom up: the loop's threads first, sockets after them.
  ServiceOptions options_;
  StaticFiles files_;
  Guard guard_;
  ClientLimits limits_;
  Control control_;
  FaultTargets faults_;
  const std::string stream_ = random_stream();
  std::optional<WallClock> clock_;
  Hub hub_;
  RecentStates states_;
  Router router_{refusal_response};
  std::unique_ptr<JobKeeper> keeper_;
  std::optional<RequestTrail> trail_;
  std::atomic<bool> loop_is_there_{false};  // read by the store's thread
  std::unique_ptr<AlertBook> alerts_;
  std::unique_ptr<Recording> recording_;
  std::optional<OldRecordings> old_recordings_;
  std::unique_ptr<InputFile> inputs_;
  std::unique_ptr<Metrics> metrics_;
  std::unique_ptr<HttpServer> http_;
  std::unique_ptr<Broadcast> broadcast_;
  std::unique_ptr<Comparison> comparison_;
  std::unique_ptr<Api> api_;
  std::unique_ptr<IoDevices> io_;  // the loop writes to it
  std::unique_ptr<RealTimeLoop> loop_;
  std::unique_ptr<Listings> listings_;
  Worker worker_;
  Worker forming_;  // compresses and indents large answers
};

Result<std::unique_ptr<Service>> Service::start(CellPtr cell, const CellFile& source,
                                                ServiceOptions options) {
  auto impl = std::make_unique<Impl>(std::move(options));
  if (auto problems = impl->start(cell, source)) return failure(std::move(*problems));
  return std::unique_ptr<Service>(new Service(std::move(impl)));
}

Service::Service(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Service::~Service() = default;
std::uint16_t Service::port() const { return impl_->http().port(); }
std::optional<std::filesystem::path> Service::recorded_to() const { return impl_->recorded_to(); }
void Service::run(bool until_signal) { impl_->run(until_signal); }
std::optional<std::string> Service::close() { return impl_->close(); }
void Service::stop() { impl_->http().stop(); }

}  // namespace armloom
