#pragma once
// The port for operators: liveness, readiness and metrics. It has its own thread, so that uploads and slow clients do
// not delay it.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/service/http/handler.h"
#include "tools/service/ports/access.h"

namespace sgm::service {

/// A dependency of the service.
struct Check {
  std::string name;
  bool ok = true;
  bool needed = false;  ///< the service is not ready without it; otherwise it is degraded
  std::string detail;
};

struct OperationsParts {
  const Access& access;
  std::function<std::string()> metrics;  ///< the text for Prometheus
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
