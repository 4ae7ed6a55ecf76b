#pragma once
// A server with a test's handler, and functions that send requests to it.

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "catch.h"
#include "client.h"
#include "test_handler.h"
#include "tools/service/http/server.h"

namespace sgm::service::http {

using Clock = std::chrono::steady_clock;

inline constexpr const char* kGet = "GET /a HTTP/1.1\r\nHost: h\r\n\r\n";

inline std::string get(const std::string& path) { return "GET " + path + " HTTP/1.1\r\nHost: h\r\n\r\n"; }

inline std::string post(const std::string& path, const std::string& body) {
  return "POST " + path + " HTTP/1.1\r\nHost: h\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

struct Served {
  explicit Served(ServerSettings settings = {}) {
    settings.drain_time = std::min<std::chrono::milliseconds>(settings.drain_time, std::chrono::milliseconds(300));
    auto started = Server::start(settings, handler);
    REQUIRE(started);
    server = std::move(*started);
  }
  TestHandler handler;
  std::unique_ptr<Server> server;
};

/// Waits until the condition holds, for at most ten seconds. Returns whether it holds.
bool soon(auto holds) {
  for (const auto end = Clock::now() + std::chrono::seconds(10); Clock::now() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    if (holds()) return true;
  return false;
}

}  // namespace sgm::service::http
