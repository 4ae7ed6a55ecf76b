#pragma once
// What a server asks of who answers its requests.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Sends the answer. From any thread, once; further calls do nothing. Where it is destroyed uncalled the client has a
/// 500. The client may be gone by then (Request::gone), or have had a 503 after ServerSettings::work_time.
using Reply = std::function<void(Response)>;

/// Takes a request's body, piece by piece, on the server's thread.
class Body {
 public:
  virtual ~Body() = default;
  /// An answer ends the request there: no more is read, and the connection closes behind it.
  virtual std::optional<Response> take(std::string_view piece) = 0;
};

/// What becomes of a request whose head has been read, before any of its body is.
struct Admission {
  std::optional<Response> refusal;  ///< sent at once; where a body would follow the connection closes behind it
  std::unique_ptr<Body> body;       ///< null: a body is not wanted, and one that is sent is a 413
  uint64_t most_bytes = 0;          ///< of the body, decoded; more is a 413
};

/// Both functions are called on the server's thread, and must not wait there. A request is there during the call alone.
/// What they throw becomes a 500.
class Handler {
 public:
  virtual ~Handler() = default;
  virtual Admission admit(const Request& request) = 0;
  /// The body is whole; `body` is what admit() made, null where it made none. HEAD comes as it is: the server leaves
  /// the body of the answer out.
  virtual void answer(const Request& request, std::unique_ptr<Body> body, Reply reply) = 0;
};

}  // namespace sgm::service::http
