#pragma once
// The metrics service: two HTTP ports, the worlds that it watches, and the inspection of uploads.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/service/http/server.h"
#include "tools/service/judge/inspector.h"
#include "tools/service/ports/access.h"
#include "tools/service/ports/work.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

struct ServiceSettings {
  AccessSettings access;
  uint16_t work_port = 0, operations_port = 0;  ///< ports to listen on; 0: any free port
  InspectorSettings inspector;
  WorkSettings work;
};

/// The metrics service. All functions but the destructor are thread-safe.
class Service {
 public:
  /// Starts to listen. Errors: those of Access, Inspector, WatchedWorlds and Server.
  static Result<std::unique_ptr<Service>> start(const ServiceSettings& settings);
  /// Same as stop(0).
  ~Service();

  uint16_t workPort() const;
  uint16_t operationsPort() const;
  WatchedWorlds& worlds();
  /// Accepts no more requests, waits up to `grace` until the current requests are answered, and ends. Blocks.
  void stop(std::chrono::milliseconds grace);

 private:
  struct Parts;
  explicit Service(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace sgm::service
