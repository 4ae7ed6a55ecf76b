#pragma once
// Passes an answer from any thread to the server's thread.

#include <boost/asio/io_context.hpp>
#include <memory>
#include <mutex>
#include <optional>

#include "tools/service/http/handler.h"

namespace sgm::service::http {

/// The receiver of an answer. Its functions are called on the server's thread.
class Answered {
 public:
  virtual ~Answered() = default;
  /// Receives the answer; nullopt if all copies of the Reply were destroyed without a call.
  virtual void deliver(std::optional<Response> response) = 0;
};

struct Letter;

/// Queue of answers for the thread of one server. Each Reply shares the ownership of the queue, so the queue may
/// outlive the server.
class Mailbox {
 public:
  explicit Mailbox(boost::asio::io_context& context) : context_(&context) {}
  /// Closes the queue: answers that are posted after this call are discarded.
  void close();
  /// Queues a letter (an answer and its receiver) for the server's thread. Allocates no memory, since a failure would
  /// let the client wait forever.
  void post(std::shared_ptr<Letter> letter) noexcept;

 private:
  std::mutex mutex_;
  boost::asio::io_context* context_;
};

/// Makes a Reply that delivers its answer to `to`. If `to` has been destroyed by then, the answer is discarded.
Reply makeReply(std::shared_ptr<Mailbox> mailbox, std::weak_ptr<Answered> to);

}  // namespace sgm::service::http
