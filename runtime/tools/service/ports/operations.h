#pragma once
// The HTTP port for operators: liveness, readiness and metrics. Its server has its own thread, so that uploads and slow
// clients of the other port do not delay it.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/service/http/handler.h"
#include "tools/service/ports/access.h"

namespace sgm::service {

/// The state of a component on which the service depends.
struct Check {
  std::string name;
  bool ok = true;
  bool needed = false;  ///< if true, the service is not ready while ok is false; otherwise it is only degraded
  std::string detail;
};

struct OperationsParts {
  const Access& access;
  std::function<std::string()> metrics;  ///< returns the metrics in Prometheus's text format
  std::function<std::vector<Check>()> checks;
};

class Operations final : public http::Handler {
 public:
  explicit Operations(OperationsParts parts);

  http::Admission admit(const http::Request& request) override;
  void answer(const http::Request& request, std::unique_ptr<http::Body> body, http::Reply reply) override;

 private:
  OperationsParts parts_;
  http::Response alive_;
};

}  // namespace sgm::service
