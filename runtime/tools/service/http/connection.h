#pragma once
// One client: its requests one after another, and how long it may take for each part of them.

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
  /// loop outlives it. Nothing happens before start() or turnAway().
  Connection(Loop& loop, boost::asio::ip::tcp::socket socket);

  void start();
  /// Says 503, and closes.
  void turnAway();
  void deliver(std::optional<Response> response) override;
  /// The server is stopping: closes where no request is being answered.
  void stopSoon();
  /// At once. It may be destroyed by then.
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
  Clock::time_point alarm_ = Clock::time_point::max();  ///< when the timer looks at the deadline; never later than it
  std::shared_ptr<std::atomic<bool>> gone_ = std::make_shared<std::atomic<bool>>(false);
  uint32_t turn_ = 0;  ///< of waiting for bytes: an earlier one that was given up means nothing
  RequestReader reader_;
  std::string kept_;  ///< read, and to be looked at once the request in work is answered
  std::unique_ptr<Body> body_;
  std::string answer_head_;
  std::shared_ptr<const std::string> answer_body_;
  bool last_answer_ = false;
  bool turned_away_ = false;
  uint64_t drained_ = 0;
};

}  // namespace sgm::service::http
