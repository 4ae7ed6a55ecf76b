#pragma once
// The port for who operates the service: whether it lives, whether it is of use, and its metrics. On a thread of its
// own, so that no upload and no slow client is in the way.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/service/http/handler.h"
#include "tools/service/ports/access.h"

namespace sgm::service {

/// One thing that the service needs.
struct Check {
  std::string name;
  bool ok = true;
  bool needed = false;  ///< the service is of no use without it; else it does less
  std::string detail;
};

struct OperationsParts {
  const Access& access;
  std::function<std::string()> metrics;  ///< the text that Prometheus reads
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
