#pragma once
// The interface of the code that answers a server's requests.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Sends the answer. May be called from any thread, once; further calls do nothing. If it is destroyed uncalled, the
/// client gets a 500. By then the client may be gone (Request::gone), or have a 503 after ServerSettings::work_time.
using Reply = std::function<void(Response)>;

/// Receives a request's body, piece by piece, in the server's thread.
class Body {
 public:
  virtual ~Body() = default;
  /// An answer ends the request: no more is read, and the connection closes after it.
  virtual std::optional<Response> take(std::string_view piece) = 0;
};

/// The decision on a request after its head, before its body.
struct Admission {
  std::optional<Response> refusal;  ///< sent immediately; if a body follows, the connection closes after it
  std::unique_ptr<Body> body;       ///< null: a body is not accepted, and gives a 413
  uint64_t most_bytes = 0;          ///< of the decoded body; more gives a 413
};

/// Both functions are called in the server's thread, and must not block. A request is valid only during the call.
/// Exceptions become a 500.
class Handler {
 public:
  virtual ~Handler() = default;
  virtual Admission admit(const Request& request) = 0;
  /// The body is complete; `body` is from admit(), and may be null. HEAD is passed on as it is: the server omits the
  /// body of the answer.
  virtual void answer(const Request& request, std::unique_ptr<Body> body, Reply reply) = 0;
};

}  // namespace sgm::service::http
