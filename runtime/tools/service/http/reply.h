#pragma once
// Passes an answer from any thread to its server's thread.

#include <boost/asio/io_context.hpp>
#include <memory>
#include <mutex>
#include <optional>

#include "tools/service/http/handler.h"

namespace sgm::service::http {

/// The receiver of an answer. Called in the server's thread.
class Answered {
 public:
  virtual ~Answered() = default;
  /// nullopt: the reply was destroyed without an answer.
  virtual void deliver(std::optional<Response> response) = 0;
};

struct Letter;

/// The mailbox of one server; replies may keep it alive longer.
class Mailbox {
 public:
  explicit Mailbox(boost::asio::io_context& context) : context_(&context) {}
  /// Discards letters that are posted later.
  void close();
  /// Allocates nothing: an answer that could not be delivered would leave its client waiting.
  void post(std::shared_ptr<Letter> letter) noexcept;

 private:
  std::mutex mutex_;
  boost::asio::io_context* context_;
};

/// A Reply to `to`, which may be destroyed meanwhile.
Reply makeReply(std::shared_ptr<Mailbox> mailbox, std::weak_ptr<Answered> to);

}  // namespace sgm::service::http
