#pragma once
// How an answer comes from any thread to the thread of its server.

#include <boost/asio/io_context.hpp>
#include <memory>
#include <mutex>
#include <optional>

#include "tools/service/http/handler.h"

namespace sgm::service::http {

/// Who waits for an answer. Called on the server's thread.
class Answered {
 public:
  virtual ~Answered() = default;
  /// Nothing: whoever had to answer has let go of it.
  virtual void deliver(std::optional<Response> response) = 0;
};

struct Letter;

/// Of one server; outlives it where replies do.
class Mailbox {
 public:
  explicit Mailbox(boost::asio::io_context& context) : context_(&context) {}
  /// What is posted from then on is thrown away.
  void close();
  /// Needs no memory: an answer that could not be delivered would leave its client waiting.
  void post(std::shared_ptr<Letter> letter) noexcept;

 private:
  std::mutex mutex_;
  boost::asio::io_context* context_;
};

/// A Reply to `to`, which may be gone by then.
Reply makeReply(std::shared_ptr<Mailbox> mailbox, std::weak_ptr<Answered> to);

}  // namespace sgm::service::http
