#pragma once
// The whole: two ports, worlds that are watched, uploads that are judged.

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
  uint16_t work_port = 0, operations_port = 0;  ///< 0: any that is free
  InspectorSettings inspector;
  WorkSettings work;
};

/// Any thread, but for its end.
class Service {
 public:
  /// Listens from then on. Errors: those of Access, Inspector, WatchedWorlds and Server.
  static Result<std::unique_ptr<Service>> start(const ServiceSettings& settings);
  /// As stop() without any time.
  ~Service();

  uint16_t workPort() const;
  uint16_t operationsPort() const;
  WatchedWorlds& worlds();
  /// Takes no more requests, answers those that have begun within that time, and ends. Blocks.
  void stop(std::chrono::milliseconds grace);

 private:
  struct Parts;
  explicit Service(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace sgm::service
