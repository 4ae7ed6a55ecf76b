#include "tools/service/service.h"

#include <atomic>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/service/judge/masters.h"
#include "tools/service/judge/reports.h"
#include "tools/service/ports/operations.h"
#include "tools/service/watch/metrics_text.h"
#include "tools/service/watch/service_state.h"

namespace sgm::service {
namespace {

/// Age from which a world's sample counts as stale. An idle world is still sampled regularly, so its sample stays
/// fresh.
constexpr std::chrono::seconds kStale{10};
/// Limits of the work port's number of connections: a maximum, and the divisor of the process's limit of open files. A
/// connection needs up to two files, its socket and its upload. All connections of both ports, including rejected ones,
/// use at most half of the process's files; the rest remains for the engine.
constexpr uint32_t kWorkConnections = 2048, kWorkShare = 5;
/// The same limits for the operations port, which has few clients.
constexpr uint32_t kOperationsConnections = 64, kOperationsShare = 16;

http::ServerSettings serverSettings(const ServiceSettings& settings, uint16_t port, const char* thread_name) {
  http::ServerSettings server;
  server.thread_name = thread_name;
  server.address = settings.access.address;
  server.port = port;
  server.connections = http::connectionsWithin(kWorkConnections, kWorkShare);
  return server;
}

/// The text of the member "detail" of a problem (RFC 9457).
std::string detailOf(const MastersAnswer& said) {
  const auto problem = nlohmann::json::parse(said.json == nullptr ? "" : *said.json, nullptr, false);
  const bool told = problem.is_object() && problem.contains("detail") && problem["detail"].is_string();
  return told ? problem["detail"].get<std::string>() : "cannot be read";
}

}  // namespace

/// The parts of the service. Each depends only on members above it, since members are destroyed in reverse order.
struct Service::Parts {
  ServiceSettings settings;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  Access access;
  Reports reports;
  std::unique_ptr<WatchedWorlds> worlds;
  /// The servers, for their counts. Null until both have started; handlers may already be called before that.
  std::atomic<const http::Server*> work_server{nullptr}, operations_server{nullptr};
  std::unique_ptr<Masters> masters;
  std::unique_ptr<Inspector> inspector;
  std::unique_ptr<Work> work;
  std::unique_ptr<Operations> operations;
  std::unique_ptr<http::Server> work_owner, operations_owner;

  Parts(const ServiceSettings& with, Access allowed) : settings(with), access(std::move(allowed)) {}
  ~Parts() {
    // Stop both servers before destroying anything: each server's handler uses the other server and the inspector,
    // whose threads call back into the handlers.
    for (const auto& server : {work_owner.get(), operations_owner.get()})
      if (server != nullptr) server->stop(std::chrono::milliseconds(0));
    inspector.reset();
  }

  ServiceState state() const {
    ServiceState state;
    state.started = started;
    if (const http::Server* server = work_server) state.work = server->counts();
    if (const http::Server* server = operations_server) {
      state.operations = server->counts();
      state.operations_port = server->port();
    }
    state.inspector = inspector->counts();
    const Result<void> takes = inspector->wouldTake();
    state.inspects = takes || takes.error().code != Code::unsupported;
    state.max_waiting = settings.inspector.waiting;
    state.max_upload_bytes = settings.work.max_upload_bytes;
    state.reports = reports.size();
    return state;
  }

  std::vector<Check> checks() const {
    std::vector<Check> all;
    const Result<void> takes = inspector->wouldTake();
    const bool full = !takes && takes.error().code == Code::limit;
    all.push_back({"validator", takes || full, false, takes ? "accepts uploads" : takes.error().message});
    // Read the reference histograms again, so that the next check shows whether the file has been damaged or repaired.
    masters->read([](const MastersAnswer&) {});
    const MastersAnswer said = masters->last();
    if (said.status != 0)
      all.push_back({"masters", said.status == 200, false, said.status == 200 ? "read" : detailOf(said)});
    const auto now = std::chrono::steady_clock::now();
    for (const WorldSample& sample : worlds->samples()) {
      const bool fresh = now - sample.taken < kStale;
      all.push_back({"world " + sample.name, fresh, true, fresh ? "is sampled" : "could not be sampled for 10 s"});
      const uint64_t failed = sample.stats.chunks_failed;
      if (failed > 0)
        all.push_back({"chunks of " + sample.name, false, false, std::to_string(failed) + " could not be meshed"});
    }
    return all;
  }
};

Service::Service(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Service::~Service() = default;

Result<std::unique_ptr<Service>> Service::start(const ServiceSettings& settings) {
  Result<Access> access = Access::create(settings.access);
  if (!access) return access.error();
  auto made = std::make_unique<Parts>(settings, std::move(*access));
  Parts& parts = *made;
  Result<std::unique_ptr<WatchedWorlds>> worlds = WatchedWorlds::create();
  if (!worlds) return worlds.error();
  parts.worlds = std::move(*worlds);
  Result<std::unique_ptr<Inspector>> inspector = Inspector::create(settings.inspector);
  if (!inspector) return inspector.error();
  parts.inspector = std::move(*inspector);
  parts.masters = std::make_unique<Masters>(*parts.inspector);
  parts.masters->read([](const MastersAnswer&) {});

  WorkSettings work = settings.work;
  work.masters_writable = !settings.inspector.masters.empty();
  parts.work = std::make_unique<Work>(WorkParts{parts.access, *parts.inspector, *parts.masters, parts.reports,
                                                *parts.worlds, [&parts] { return parts.state(); }},
                                      work);
  parts.operations = std::make_unique<Operations>(
      OperationsParts{parts.access, [&parts] { return metricsText(parts.state(), parts.worlds->samples()); },
                      [&parts] { return parts.checks(); }});
  http::ServerSettings operations = serverSettings(settings, settings.operations_port, "sgm operations");
  operations.connections = http::connectionsWithin(kOperationsConnections, kOperationsShare);
  Result<std::unique_ptr<http::Server>> second = http::Server::start(operations, *parts.operations);
  if (!second) return second.error();
  parts.operations_owner = std::move(*second);
  parts.operations_server = parts.operations_owner.get();
  Result<std::unique_ptr<http::Server>> first =
      http::Server::start(serverSettings(settings, settings.work_port, "sgm work"), *parts.work);
  if (!first) return first.error();
  parts.work_owner = std::move(*first);
  parts.work_server = parts.work_owner.get();
  return std::unique_ptr<Service>(new Service(std::move(made)));
}

uint16_t Service::workPort() const { return parts_->work_owner->port(); }
uint16_t Service::operationsPort() const { return parts_->operations_owner->port(); }
WatchedWorlds& Service::worlds() { return *parts_->worlds; }

void Service::stop(std::chrono::milliseconds grace) {
  parts_->work_owner->stop(grace);
  parts_->operations_owner->stop(std::chrono::milliseconds(0));
}

}  // namespace sgm::service
