#pragma once
// The connection of one client, which handles its requests one after another and limits the time of each phase.

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tools/service/http/loop.h"
#include "tools/service/http/request_reader.h"

namespace sgm::service::http {

class Connection final : public Answered, public std::enable_shared_from_this<Connection> {
 public:
  /// Contract: `loop` outlives the connection. The connection does nothing before start() or turnAway().
  Connection(Loop& loop, boost::asio::ip::tcp::socket socket);

  void start();
  /// Sends a 503 and closes the connection.
  void turnAway();
  void deliver(std::optional<Response> response) override;
  /// Called when the server stops. Closes the connection unless a request is pending, that is, its head has arrived but
  /// it is not answered yet.
  void stopSoon();
  /// Closes the connection immediately. May destroy it, so the caller must not use it afterwards.
  void close() noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { idle, head, body, work, write, drain, closed };

  void enter(Phase phase, std::chrono::milliseconds time);
  void setAlarm();
  void onAlarm();
  void onTooSlow();

  void watch();
  void awaitBytes();
  void onBytes();
  void read(std::string_view bytes);
  bool admit();
  std::optional<Response> takePiece();
  void work();
  void goOn();
  void send(Response response, bool last);
  void onSent();
  void letGoOfAnswer() noexcept;
  void drain();
  template <class Call>
  auto guarded(Call call);

  Loop& loop_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  Phase phase_ = Phase::idle;
  Clock::time_point deadline_ = Clock::time_point::max();
  /// Time at which the timer fires, never later than deadline_. When the timer fires before deadline_, the connection
  /// starts it again.
  Clock::time_point alarm_ = Clock::time_point::max();
  std::shared_ptr<std::atomic<bool>> gone_ = std::make_shared<std::atomic<bool>>(false);
  /// Number of the current wait for bytes. A wait that completes with an older number was cancelled, and is ignored.
  uint32_t turn_ = 0;
  RequestReader reader_;
  std::string kept_;  ///< bytes that have arrived but are not yet parsed: they belong to the rest of the current
                      ///< request or to the next one
  std::unique_ptr<Body> body_;
  std::string answer_head_;
  std::shared_ptr<const std::string> answer_body_;
  bool last_answer_ = false;
  bool turned_away_ = false;
  uint64_t drained_ = 0;
};

}  // namespace sgm::service::http
