#pragma once
// The interface of the code that answers a server's requests.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Sends the answer to a request. May be called from any thread, once; further calls do nothing. If the function is
/// destroyed without a call, the client gets a 500. By the time of the call the client may have disconnected
/// (Request::gone), or have received a 503 after ServerSettings::work_time.
using Reply = std::function<void(Response)>;

/// Receives the body of a request, piece by piece, in the server's thread.
class Body {
 public:
  virtual ~Body() = default;
  /// Receives the next piece. If it returns an answer, the request ends with it: the rest of the body is not read, and
  /// the connection closes afterwards.
  virtual std::optional<Response> take(std::string_view piece) = 0;
};

/// The handler's decision on a request, made after its head has arrived and before its body.
struct Admission {
  /// The answer to a rejected request, sent immediately; if a body follows, the connection closes afterwards.
  std::optional<Response> refusal;
  std::unique_ptr<Body> body;  ///< receives the body; null: a body is not accepted, and gives a 413
  uint64_t max_bytes = 0;      ///< limit of the decoded body; a larger body gives a 413
};

/// Answers the requests of a server. Both functions are called in the server's thread, and must not block. The request
/// is valid only during the call. An exception gives a 500.
class Handler {
 public:
  virtual ~Handler() = default;
  virtual Admission admit(const Request& request) = 0;
  /// Called when the body is complete. `body` is the object that admit() returned, and may be null. A HEAD request is
  /// not converted to GET: the server omits the body of the answer.
  virtual void answer(const Request& request, std::unique_ptr<Body> body, Reply reply) = 0;
};

}  // namespace sgm::service::http
