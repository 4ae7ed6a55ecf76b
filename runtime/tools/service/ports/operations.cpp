#include "tools/service/ports/operations.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "tools/service/ports/routes.h"

namespace sgm::service {
namespace {

enum OperationsEndpoint { metrics, health, readiness };

constexpr Route kOperationsRoutes[] = {
    {"/metrics", "GET, HEAD", metrics}, {"/healthz", "GET, HEAD", health}, {"/readyz", "GET, HEAD", readiness}};

/// The answer to a readiness request. detailed: whether it lists the checks, which only authorized clients may see.
http::Response readinessOf(const std::vector<Check>& checks, bool detailed) {
  bool ready = true, degraded = false;
  nlohmann::json list = nlohmann::json::array();
  for (const Check& check : checks) {
    ready = ready && (check.ok || !check.needed);
    degraded = degraded || !check.ok;
    if (detailed) list.push_back({{"name", check.name}, {"ok", check.ok}, {"detail", check.detail}});
  }
  const nlohmann::json json{{"ready", ready}, {"degraded", degraded}, {"checks", std::move(list)}};
  return http::makeResponse(ready ? 200 : 503, "application/json",
                            json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

Operations::Operations(OperationsParts parts)
    : parts_(std::move(parts)), alive_(http::makeResponse(200, "text/plain; charset=utf-8", "ok\n")) {}

http::Admission Operations::admit(const http::Request& request) {
  http::Admission admission;
  std::variant<Routed, http::Response> found = routed(kOperationsRoutes, request);
  // Allow health probes without a Host header, since HTTP/1.0 probes send none. This is safe: every browser sends a
  // Host header, so a page of another site cannot omit it.
  const bool probe = !request.field("Host") && !request.field("Origin") && std::holds_alternative<Routed>(found) &&
                     std::get<Routed>(found).route->endpoint != metrics;
  if (!probe) admission.refusal = parts_.access.refuse(request);
  if (admission.refusal) return admission;
  if (std::holds_alternative<http::Response>(found)) {
    admission.refusal = std::get<http::Response>(std::move(found));
  } else if (std::get<Routed>(found).route->endpoint == metrics) {
    admission.refusal = parts_.access.refuseStranger(request);
  }
  return admission;
}

void Operations::answer(const http::Request& request, std::unique_ptr<http::Body>, http::Reply reply) {
  const std::variant<Routed, http::Response> found = routed(kOperationsRoutes, request);
  switch (std::get<Routed>(found).route->endpoint) {
    case metrics:
      return reply(http::makeResponse(200, "text/plain; version=0.0.4; charset=utf-8", parts_.metrics()));
    case health:
      return reply(alive_);
    case readiness:
      return reply(readinessOf(parts_.checks(), !parts_.access.refuseStranger(request)));
  }
}

}  // namespace sgm::service
