#pragma once
// The state of the service, from which the metrics and the summary are written.

#include <chrono>

#include "tools/service/http/server.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

struct ServiceState {
  std::chrono::steady_clock::time_point started;
  uint16_t operations_port = 0;
  http::ServerCounts work, operations;
  InspectorCounts inspector;
  bool inspects = false;     ///< whether the service can inspect uploads
  unsigned max_waiting = 0;  ///< maximum number of uploads in the inspector's queue
  uint64_t max_upload_bytes = 0;
  size_t reports = 0;
};

}  // namespace sgm::service
