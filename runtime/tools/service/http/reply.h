#pragma once
// Passes an answer from any thread to the thread of its server.

#include <boost/asio/io_context.hpp>
#include <memory>
#include <mutex>
#include <optional>

#include "tools/service/http/handler.h"

namespace sgm::service::http {

/// Receives an answer. The functions are called in the server's thread.
class Answered {
 public:
  virtual ~Answered() = default;
  /// nullopt: the Reply was destroyed without an answer.
  virtual void deliver(std::optional<Response> response) = 0;
};

struct Letter;

/// The mailbox of one server. A Reply shares its ownership, so the mailbox may outlive the server.
class Mailbox {
 public:
  explicit Mailbox(boost::asio::io_context& context) : context_(&context) {}
  /// Letters that are posted afterwards are discarded.
  void close();
  /// Queues a letter for the server's thread. Allocates no memory: if it failed, the client would wait for the answer
  /// forever.
  void post(std::shared_ptr<Letter> letter) noexcept;

 private:
  std::mutex mutex_;
  boost::asio::io_context* context_;
};

/// Makes a Reply that delivers to `to`. If `to` has been destroyed by then, the answer is discarded.
Reply makeReply(std::shared_ptr<Mailbox> mailbox, std::weak_ptr<Answered> to);

}  // namespace sgm::service::http
