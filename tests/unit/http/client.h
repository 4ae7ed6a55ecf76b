#pragma once
// An HTTP client on a socket of its own: sends any text, and returns answers as received.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "catch.h"

namespace sgm::service::http {

struct Answer {
  int status = 0;
  std::map<std::string, std::string> fields;
  std::string body;
};

class Client {
 public:
  explicit Client(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    REQUIRE(socket_ >= 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const auto* address = static_cast<const sockaddr*>(static_cast<const void*>(&at));
    REQUIRE(::connect(socket_, address, sizeof at) == 0);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { ::close(socket_); }

  /// Sends a text. Returns false if the server has closed the connection.
  bool say(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      text.remove_prefix(static_cast<size_t>(sent));
    }
    return true;
  }

  /// Receives the next answer; nullopt if the connection ended instead, or after ten seconds. without_body: the answer
  /// to a HEAD request is expected.
  std::optional<Answer> hear(bool without_body = false) {
    size_t end = 0;
    while ((end = heard_.find("\r\n\r\n")) == std::string::npos)
      if (!more()) return std::nullopt;
    Answer answer;
    const std::string head = heard_.substr(0, end + 2);
    heard_.erase(0, end + 4);
    REQUIRE(head.substr(0, 9) == "HTTP/1.1 ");
    answer.status = std::stoi(head.substr(9));
    for (size_t at = head.find("\r\n") + 2; at < head.size();) {
      const size_t line_end = head.find("\r\n", at), colon = head.find(": ", at);
      REQUIRE(colon < line_end);
      REQUIRE(answer.fields.emplace(head.substr(at, colon - at), head.substr(colon + 2, line_end - colon - 2)).second);
      at = line_end + 2;
    }
    const auto length = answer.fields.find("Content-Length");
    const size_t size = length == answer.fields.end() || without_body ? 0 : std::stoul(length->second);
    while (heard_.size() < size)
      if (!more()) return std::nullopt;
    answer.body = heard_.substr(0, size);
    heard_.erase(0, size);
    return answer;
  }

  std::optional<Answer> ask(std::string_view text) {
    say(text);
    return hear();
  }

  /// Whether the server closes the connection within this time, without sending more.
  bool ended(std::chrono::milliseconds within = std::chrono::seconds(10)) {
    return heard_.empty() && !more(within) && at_end_;
  }

  /// Whether the connection ended by a reset, which discards answers that have not been received.
  bool wasReset() const { return reset_; }
  void endSaying() { ::shutdown(socket_, SHUT_WR); }
  int socket() const { return socket_; }

 private:
  bool more(std::chrono::milliseconds within = std::chrono::seconds(10)) {
    pollfd wait{socket_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(within.count())) <= 0) return false;
    char bytes[4096];
    const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
    at_end_ = count <= 0;
    reset_ = count < 0;
    if (count > 0) heard_.append(bytes, static_cast<size_t>(count));
    return count > 0;
  }

  int socket_;
  std::string heard_;
  bool at_end_ = false;
  bool reset_ = false;
};

}  // namespace sgm::service::http
