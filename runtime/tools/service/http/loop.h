#pragma once
// State that all connections of a server share. Only the server's thread uses it, except the counts and the mailbox.

#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "tools/service/http/reply.h"
#include "tools/service/http/server.h"
#include "tools/service/http/unsent.h"

namespace sgm::service::http {

class Connection;

struct LoopCounts {
  std::atomic<uint64_t> connections{0}, accepted{0}, turned_away{0};
  std::array<std::atomic<uint64_t>, 600> answers{};
};

struct Loop {
  Loop(const ServerSettings& with, Handler& by) : settings(with), handler(by) {}

  ServerSettings settings;
  Handler& handler;
  LoopCounts counts;
  boost::asio::io_context context{1};
  std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>(context);
  /// Read buffer. All connections share it, so that idle connections need no memory for one.
  std::vector<char> buffer = std::vector<char>(size_t{16} << 10);
  std::unordered_set<std::shared_ptr<Connection>> connections;
  Unsent unsent{settings.unsent_bytes};
  size_t turned_away_now = 0;  ///< number of open connections that only receive a 503
  bool stopping = false;

  /// The current time as the value of the header Date, formatted once a second.
  std::string_view date();
  /// Removes a closed connection. If the server is stopping and this was the last connection, the loop ends.
  void forget(const std::shared_ptr<Connection>& connection, bool turned_away);

 private:
  long long date_of_ = -1;
  std::string date_;
};

}  // namespace sgm::service::http
