#include "tools/service/http/connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/write.hpp>
#include <utility>

#include "tools/service/http/answer.h"

namespace sgm::service::http {

namespace {

namespace net = boost::asio;
using ErrorCode = boost::system::error_code;

Response failed() {
  return makeResponse(Problem{500, "internal_error", "The server could not answer; its log may give the reason.", {}});
}

Response unavailable(const char* code, const char* detail) {
  Response response = makeResponse(Problem{503, code, detail, {}});
  response.fields.push_back({"Retry-After", "1"});
  response.close = true;
  return response;
}

/// Enables TCP keep-alive to detect clients that are gone. Without probes, a client that has closed its socket looks
/// like one that has only finished sending, and a host without power looks like an idle client. In the first case, the
/// client's system answers a probe by resetting the connection; in the second, the probe gets no answer.
void askWhetherThere(net::ip::tcp::socket& socket) {
  ErrorCode ignored;
  socket.set_option(net::socket_base::keep_alive(true), ignored);
#if defined(TCP_KEEPIDLE) && defined(TCP_KEEPINTVL) && defined(TCP_KEEPCNT)
  const auto set = [&](int option, int value) {
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  };
  set(TCP_KEEPIDLE, 30);   // seconds without data before the first probe
  set(TCP_KEEPINTVL, 15);  // seconds between probes
  set(TCP_KEEPCNT, 4);
#endif
}

ReaderLimits readerLimits(const ServerSettings& settings) {
  return {settings.line_bytes, settings.head_bytes, settings.fields};
}

}  // namespace

/// Wraps a completion handler: the wrapper keeps the connection alive until the handler is called. If the handler
/// throws because memory is short, the wrapper closes the connection, which would otherwise hang.
template <class Call>
auto Connection::guarded(Call call) {
  return [self = shared_from_this(), call](const ErrorCode& error, auto...) {
    if (self->phase_ == Phase::closed) return;
    try {
      call(error);
    } catch (...) {
      self->close();
    }
  };
}

Connection::Connection(Loop& loop, net::ip::tcp::socket socket)
    : loop_(loop), socket_(std::move(socket)), timer_(loop.context), reader_(readerLimits(loop.settings), gone_) {}

void Connection::start() {
  ErrorCode ignored;
  socket_.set_option(net::ip::tcp::no_delay(true), ignored);
  askWhetherThere(socket_);
  watch();
  enter(Phase::idle, loop_.settings.idle_time);
  awaitBytes();
}

void Connection::turnAway() {
  turned_away_ = true;
  send(unavailable("too_many_connections", "The server has too many connections; try again later."), true);
}

void Connection::stopSoon() {
  if (phase_ == Phase::idle || phase_ == Phase::head) close();
}

void Connection::close() noexcept {
  if (phase_ == Phase::closed) return;
  phase_ = Phase::closed;
  ErrorCode ignored;
  socket_.close(ignored);
  timer_.cancel();
  gone_->store(true, std::memory_order_relaxed);
  body_.reset();
  letGoOfAnswer();
  loop_.forget(shared_from_this(), turned_away_);
}

/// Starts a phase of the connection, which must end within `time` from now. Activity of the client does not extend the
/// limit.
void Connection::enter(Phase phase, std::chrono::milliseconds time) {
  phase_ = phase;
  deadline_ = Clock::now() + time;
  // A running timer is set again only if the new deadline is earlier. If the deadline is later, the timer fires early
  // and is then set to the deadline. So most requests never set the timer.
  if (deadline_ < alarm_) setAlarm();
}

void Connection::setAlarm() {
  alarm_ = deadline_;
  timer_.expires_at(alarm_);
  timer_.async_wait(guarded([this](const ErrorCode& error) {
    if (!error) onAlarm();
  }));
}

void Connection::onAlarm() {
  alarm_ = Clock::time_point::max();
  if (Clock::now() >= deadline_) return onTooSlow();
  if (deadline_ < alarm_) setAlarm();
}

void Connection::onTooSlow() {
  if (phase_ == Phase::work) {
    gone_->store(true, std::memory_order_relaxed);
    return send(unavailable("work_timeout", "The answer took too long to make; try again later."), true);
  }
  if (phase_ != Phase::head && phase_ != Phase::body) return close();
  ++turn_;
  ErrorCode ignored;
  socket_.cancel(ignored);
  send(makeResponse(Problem{408, "timeout", "The request took too long to arrive.", {}}), true);
}

/// Closes the connection when the client resets it, also while no read or write is pending. A half-closed connection
/// stays open. Urgent data triggers the same event without a reset: the connection then stays open, but is no longer
/// watched.
void Connection::watch() {
  socket_.async_wait(net::socket_base::wait_error, guarded([this](const ErrorCode& error) {
                       pollfd ended{socket_.native_handle(), 0, 0};
                       if (!error && ::poll(&ended, 1, 0) > 0) close();
                     }));
}

void Connection::awaitBytes() {
  socket_.async_wait(net::socket_base::wait_read, guarded([this, turn = ++turn_](const ErrorCode& error) {
                       if (turn != turn_) return;
                       if (error) return close();
                       onBytes();
                     }));
}

void Connection::onBytes() {
  ErrorCode error;
  socket_.non_blocking(true, error);
  const size_t count = error ? 0 : socket_.read_some(net::buffer(loop_.buffer), error);
  if (error == net::error::would_block || error == net::error::interrupted) return awaitBytes();
  if (error) return close();
  if (phase_ != Phase::drain) return read({loop_.buffer.data(), count});
  drained_ += count;
  if (drained_ > loop_.settings.drain_bytes) return close();
  awaitBytes();
}

void Connection::read(std::string_view bytes) {
  using Event = RequestReader::Event;
  for (;;) {
    switch (reader_.next(bytes)) {
      case Event::starved:
        if (reader_.between() && phase_ != Phase::idle) enter(Phase::idle, loop_.settings.idle_time);
        if (reader_.inHead() && !reader_.between() && phase_ != Phase::head)
          enter(Phase::head, loop_.settings.head_time);
        return awaitBytes();
      case Event::head:
        enter(Phase::body, loop_.settings.body_time);
        if (admit()) break;
        kept_ = bytes;
        return;
      case Event::go_on:
        kept_ = bytes;
        return goOn();
      case Event::piece:
        if (auto response = takePiece()) return send(std::move(*response), true);
        break;
      case Event::end:
        kept_ = bytes;
        return work();
      case Event::refused:
        return send(makeResponse(reader_.refusal()), true);
    }
  }
}

/// Passes the request's head to the handler. Returns false if the request has been answered and its body is not wanted.
bool Connection::admit() {
  Admission admission;
  try {
    admission = loop_.handler.admit(reader_.request());
  } catch (...) {
    admission.refusal = failed();
  }
  if (admission.refusal) {
    const bool last = reader_.hasBody();
    if (!last) reader_.finish();
    send(std::move(*admission.refusal), last);
    return false;
  }
  body_ = std::move(admission.body);
  if (body_) reader_.allow(admission.max_bytes);
  return true;
}

std::optional<Response> Connection::takePiece() {
  try {
    return body_->take(reader_.piece());
  } catch (...) {
    return failed();
  }
}

void Connection::work() {
  enter(Phase::work, loop_.settings.work_time);
  Reply reply = makeReply(loop_.mailbox, weak_from_this());
  try {
    loop_.handler.answer(reader_.request(), std::move(body_), std::move(reply));
  } catch (...) {
    // The exception needs no handling. If all copies of the Reply have been destroyed, the client gets a 500. Otherwise
    // the owner of a copy will answer.
  }
}

void Connection::deliver(std::optional<Response> response) {
  if (phase_ != Phase::work) return;
  try {
    send(response ? std::move(*response) : failed(), false);
  } catch (...) {
    close();
  }
}

void Connection::goOn() {
  constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  net::async_write(socket_, net::buffer(kContinue.data(), kContinue.size()), guarded([this](const ErrorCode& error) {
                     if (phase_ != Phase::body) return;
                     if (error) return close();
                     const std::string bytes = std::exchange(kept_, {});
                     read(bytes);
                   }));
}

void Connection::send(Response response, bool last) {
  if (!isSendable(response)) response = failed();
  body_.reset();
  letGoOfAnswer();
  if (reader_.request().method != "HEAD" && mayHaveBody(response.status)) {
    if (!loop_.unsent.hold(response.body))
      response = unavailable("too_much_unsent", "Too many clients read their answers slowly; try again later.");
    answer_body_ = response.body;
  }
  last_answer_ = last || response.close || !reader_.keepAlive() || loop_.stopping;
  answer_head_ = answerHead(response, {reader_.http11(), last_answer_, loop_.date()});
  loop_.counts.answers[static_cast<size_t>(response.status)].fetch_add(1, std::memory_order_relaxed);
  enter(Phase::write, loop_.settings.write_time);
  const std::array<net::const_buffer, 2> parts = {net::buffer(answer_head_),
                                                  answer_body_ ? net::buffer(*answer_body_) : net::const_buffer()};
  net::async_write(socket_, parts, guarded([this](const ErrorCode& error) {
                     if (error) return close();
                     onSent();
                   }));
}

void Connection::onSent() {
  std::string().swap(answer_head_);
  letGoOfAnswer();
  if (last_answer_ || loop_.stopping) return drain();
  const std::string bytes = std::exchange(kept_, {});
  read(bytes);
}

void Connection::letGoOfAnswer() noexcept {
  loop_.unsent.release(answer_body_);
  answer_body_.reset();
}

void Connection::drain() {
  kept_.clear();
  ErrorCode error;
  socket_.shutdown(net::ip::tcp::socket::shutdown_send, error);
  if (error) return close();
  enter(Phase::drain, loop_.settings.drain_time);
  awaitBytes();
}

}  // namespace sgm::service::http
