#include "tools/service/http/server.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cerrno>
#include <ctime>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "base/blocked_signals.h"
#include "base/plain_text.h"
#include "base/thread_name.h"
#include "tools/service/http/answer.h"
#include "tools/service/http/connection.h"
#include "tools/service/http/loop.h"

namespace sgm::service::http {

std::string_view Loop::date() {
  const long long now = std::time(nullptr);
  if (now != date_of_) {
    date_ = httpDate(now);
    date_of_ = now;
  }
  return date_;
}

void Loop::forget(const std::shared_ptr<Connection>& connection, bool turned_away) {
  connections.erase(connection);
  if (turned_away)
    --turned_away_now;
  else
    counts.connections.fetch_sub(1, std::memory_order_relaxed);
  if (stopping && connections.empty()) context.stop();
}

namespace {

namespace net = boost::asio;
using Tcp = net::ip::tcp;

/// Maximum number of surplus clients that concurrently get a 503: an eighth of ServerSettings::connections, but at most
/// kMaxTurnedAway and at least kMinTurnedAway. The connections of further clients are closed without an answer.
constexpr size_t kMaxTurnedAway = 64;
constexpr size_t kMinTurnedAway = 8;

size_t maxTurnedAway(size_t connections) { return std::clamp(connections / 8, kMinTurnedAway, kMaxTurnedAway); }

/// A reserved file descriptor. When the process cannot open more files, the server releases it to accept and close the
/// next client, which would otherwise wait.
class SpareDescriptor {
 public:
  SpareDescriptor() { reopen(); }
  ~SpareDescriptor() { giveUp(); }
  SpareDescriptor(const SpareDescriptor&) = delete;
  SpareDescriptor& operator=(const SpareDescriptor&) = delete;

  /// Reserves a descriptor, if none is reserved. Returns false if that fails.
  bool reopen() {
    if (descriptor_ < 0) descriptor_ = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    return descriptor_ >= 0;
  }
  /// Releases the reserved descriptor. Returns false if none was reserved.
  bool giveUp() {
    const bool had = descriptor_ >= 0;
    if (had) ::close(descriptor_);
    descriptor_ = -1;
    return had;
  }

 private:
  int descriptor_ = -1;
};

/// Maximum number of clients that are accepted before other events are processed.
constexpr int kClientsAtOnce = 16;

/// Pause before the server accepts clients again after memory or file descriptors have run out.
constexpr std::chrono::milliseconds kAcceptPause{50};

class LoopServer final : public Server {
 public:
  LoopServer(const ServerSettings& settings, Handler& handler) : loop_(settings, handler) {}
  ~LoopServer() override { stop(std::chrono::milliseconds(0)); }

  Result<void> listen();
  Result<void> run();

  uint16_t port() const override { return port_; }
  ServerCounts counts() const override;
  void stop(std::chrono::milliseconds grace) override;

 private:
  void turn();
  void accept();
  bool welcomeAll();
  bool closeNext();
  void welcome(Tcp::socket socket);
  void beginStop(std::chrono::milliseconds grace);
  void closeAll();
  void forEach(auto call);

  Loop loop_;
  SpareDescriptor spare_;
  Tcp::acceptor acceptor_{loop_.context};
  net::steady_timer pause_{loop_.context}, grace_{loop_.context};
  net::executor_work_guard<net::io_context::executor_type> work_{loop_.context.get_executor()};
  uint16_t port_ = 0;
  bool accepting_ = false;  ///< whether accept() is pending: a wait for the next client, or the pause kAcceptPause
  std::mutex stop_mutex_;
  std::thread thread_;
};

Result<void> LoopServer::listen() {
  boost::system::error_code error;
  const net::ip::address address = net::ip::make_address(loop_.settings.address, error);
  if (error)
    return Error{Code::invalid_argument, "'" + loop_.settings.address + "' is not a numeric IPv4 or IPv6 address"};
  const Tcp::endpoint endpoint(address, loop_.settings.port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
  if (!error) acceptor_.non_blocking(true, error);
  if (!error) port_ = acceptor_.local_endpoint(error).port();
  if (error)
    return Error{Code::io, "cannot listen on " + loop_.settings.address + " port " +
                               std::to_string(loop_.settings.port) + ": " + systemMessage(error)};
  return {};
}

Result<void> LoopServer::run() {
  accept();
  const BlockedSignals blocked;
  try {
    thread_ = std::thread([this] {
      nameThread(loop_.settings.thread_name);
      while (!loop_.context.stopped()) turn();
    });
  } catch (const std::system_error& error) {
    return Error{Code::limit, std::string("cannot start a thread for the server: ") + error.what()};
  }
  return {};
}

/// Runs the event loop until the server stops, or until an event handler throws because memory has run out. After such
/// an exception, the caller calls turn() again, and the connections continue. If no accept() is pending, because
/// starting it failed, turn() soon tries to start it again.
void LoopServer::turn() try {
  if (accepting_) {
    loop_.context.run();
  } else {
    loop_.context.run_for(kAcceptPause);
    if (acceptor_.is_open()) accept();
  }
} catch (...) {
}

/// Waits until a client can be accepted, then accepts it in a separate call. async_accept() is not used: if it ran out
/// of memory, its handler would never be called.
void LoopServer::accept() {
  acceptor_.async_wait(net::socket_base::wait_read, [this](const boost::system::error_code&) {
    accepting_ = false;
    if (!acceptor_.is_open()) return;
    if (welcomeAll()) return accept();
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](const boost::system::error_code&) {
      accepting_ = false;
      if (acceptor_.is_open()) accept();
    });
    accepting_ = true;
  });
  accepting_ = true;
}

/// Accepts the waiting clients. Returns false if the system has no resources for another client at present.
bool LoopServer::welcomeAll() {
  for (int i = 0; i < kClientsAtOnce; ++i) {
    Tcp::socket socket(loop_.context);
    boost::system::error_code error;
    acceptor_.accept(socket, error);
    if (error == net::error::would_block) return true;
    if (error == net::error::connection_aborted || error == net::error::interrupted) continue;
    if (error == net::error::no_descriptors || error.value() == ENFILE) {
      if (!closeNext()) return false;
      continue;
    }
    if (error) return false;
    welcome(std::move(socket));
  }
  return true;
}

/// Accepts the next client and closes it at once. Returns false if that fails and the client still waits.
bool LoopServer::closeNext() {
  if (!spare_.giveUp()) {
    spare_.reopen();
    return false;
  }
  const int client = ::accept(acceptor_.native_handle(), nullptr, nullptr);
  if (client >= 0) {
    ::close(client);
    loop_.counts.turned_away.fetch_add(1, std::memory_order_relaxed);
  }
  return spare_.reopen() && client >= 0;
}

void LoopServer::welcome(Tcp::socket socket) try {
  const bool too_many = loop_.connections.size() - loop_.turned_away_now >= loop_.settings.connections;
  if (too_many) {
    loop_.counts.turned_away.fetch_add(1, std::memory_order_relaxed);
    if (loop_.turned_away_now >= maxTurnedAway(loop_.settings.connections)) return;
  }
  const auto connection = std::make_shared<Connection>(loop_, std::move(socket));
  loop_.connections.insert(connection);
  if (too_many) {
    ++loop_.turned_away_now;
  } else {
    loop_.counts.accepted.fetch_add(1, std::memory_order_relaxed);
    loop_.counts.connections.fetch_add(1, std::memory_order_relaxed);
  }
  try {
    too_many ? connection->turnAway() : connection->start();
  } catch (...) {
    connection->close();
  }
} catch (...) {
  // There is no memory for this client: its socket is closed.
}

ServerCounts LoopServer::counts() const {
  ServerCounts counts;
  counts.connections = loop_.counts.connections.load(std::memory_order_relaxed);
  counts.accepted = loop_.counts.accepted.load(std::memory_order_relaxed);
  counts.turned_away = loop_.counts.turned_away.load(std::memory_order_relaxed);
  for (size_t i = 0; i < counts.answers.size(); ++i)
    counts.answers[i] = loop_.counts.answers[i].load(std::memory_order_relaxed);
  return counts;
}

void LoopServer::stop(std::chrono::milliseconds grace) {
  const std::lock_guard lock(stop_mutex_);
  if (thread_.joinable()) {
    try {
      net::post(loop_.context, [this, grace] { beginStop(grace); });
    } catch (...) {
      loop_.context.stop();  // no memory for an orderly stop: stop at once
    }
    thread_.join();
  }
  loop_.mailbox->close();
  loop_.connections.clear();
}

/// Calls `call` for every connection. `call` may close that connection.
void LoopServer::forEach(auto call) {
  for (auto at = loop_.connections.begin(); at != loop_.connections.end();) {
    const std::shared_ptr<Connection> connection = *at++;
    call(*connection);
  }
}

void LoopServer::beginStop(std::chrono::milliseconds grace) {
  loop_.stopping = true;
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  forEach([](Connection& connection) { connection.stopSoon(); });
  if (loop_.connections.empty() || grace <= std::chrono::milliseconds(0)) return closeAll();
  try {
    grace_.expires_after(grace);
    grace_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled) closeAll();
    });
  } catch (...) {
    closeAll();
  }
}

void LoopServer::closeAll() {
  forEach([](Connection& connection) { connection.close(); });
  loop_.context.stop();
}

}  // namespace

uint32_t connectionsWithin(uint32_t most, uint32_t share) {
  constexpr rlim_t kLeast = 8;
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return std::min<uint32_t>(most, kLeast);
  return static_cast<uint32_t>(std::max(std::min<rlim_t>(most, files.rlim_cur / share), kLeast));
}

Result<std::unique_ptr<Server>> Server::start(const ServerSettings& settings, Handler& handler) {
  try {
    auto server = std::make_unique<LoopServer>(settings, handler);
    if (auto listening = server->listen(); !listening) return listening.error();
    if (auto running = server->run(); !running) return running.error();
    return std::unique_ptr<Server>(std::move(server));
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "not enough memory for a server"};
  } catch (const std::system_error& error) {
    return Error{Code::io, std::string("cannot start a server: ") + error.what()};
  }
}

}  // namespace sgm::service::http
