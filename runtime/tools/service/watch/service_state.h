#pragma once
// The state of the service, from which its metrics and its summary are written.

#include <chrono>

#include "tools/service/http/server.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

struct ServiceState {
  std::chrono::steady_clock::time_point started;
  uint16_t operations_port = 0;
  http::ServerCounts work, operations;
  InspectorCounts inspector;
  bool inspects = false;     ///< whether uploads can be inspected
  unsigned max_waiting = 0;  ///< maximum number of waiting uploads
  uint64_t max_upload_bytes = 0;
  size_t reports = 0;
};

}  // namespace sgm::service
