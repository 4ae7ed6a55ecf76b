#pragma once
// Interface for the code that answers the requests of a server.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Sends the answer to a request. Thread-safe; only the first call has an effect. If all copies are destroyed without a
/// call, the client gets a 500. At the time of the call, the client may have disconnected (see Request::gone) or got a
/// 503 after ServerSettings::work_time; the answer is then discarded.
using Reply = std::function<void(Response)>;

/// Receives the body of a request piece by piece, on the server's thread.
class Body {
 public:
  virtual ~Body() = default;
  /// Receives the next piece of the body. If take() returns an answer, the server sends the answer at once, ignores the
  /// rest of the body, and closes the connection.
  virtual std::optional<Response> take(std::string_view piece) = 0;
};

/// The handler's decision about a request whose head has arrived, but not its body.
struct Admission {
  /// If set, the request is rejected with this answer. If the request has a body, the connection then closes.
  std::optional<Response> refusal;
  std::unique_ptr<Body> body;  ///< receives the request's body; if null, a request with a body gets a 413
  uint64_t max_bytes = 0;      ///< maximum size of the decoded body; a larger body gets a 413
};

/// Answers the requests of a server. Both functions are called on the server's thread and must not block. The request
/// is valid only during the call. An exception gives a 500.
class Handler {
 public:
  virtual ~Handler() = default;
  virtual Admission admit(const Request& request) = 0;
  /// Called when the body is complete. body: the object that admit() returned, or null. HEAD requests arrive as HEAD:
  /// the server omits the body of the answer.
  virtual void answer(const Request& request, std::unique_ptr<Body> body, Reply reply) = 0;
};

}  // namespace sgm::service::http
