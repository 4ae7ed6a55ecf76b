#pragma once
// An HTTP server of files with range requests, on a port of its own, that can simulate faults.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace sgm {

enum class Fault {
  none,
  no_ranges,    ///< ignores the requested range, and sends the whole file
  other_range,  ///< sends a different range than the requested one
  cut_off,      ///< sends fewer bytes than the header announces
  endless,      ///< sends more bytes than were requested
  damaged,      ///< sends wrong bytes
  fails,        ///< answers 503
  refuses,      ///< answers 403
  is_silent,    ///< accepts requests, but does not answer
  hangs_up,     ///< closes the connection instead of answering
};

class FileServer {
 public:
  /// Port 0: any free port.
  explicit FileServer(std::filesystem::path root, uint16_t port = 0) : root_(std::move(root)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 64) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("the test's server cannot listen");
    port_ = ntohs(address.sin_port);
    accepting_ = std::thread([this] { accept(); });
  }
  ~FileServer() {
    is_stopped_ = true;
    ::shutdown(listener_, SHUT_RDWR);
    accepting_.join();
    ::close(listener_);
    {
      const std::lock_guard lock(mutex_);
      for (const int connection : open_) ::shutdown(connection, SHUT_RDWR);
    }
    for (std::thread& thread : serving_) thread.join();
  }
  FileServer(const FileServer&) = delete;
  FileServer& operator=(const FileServer&) = delete;

  uint16_t port() const { return port_; }
  std::string address() const { return "http://127.0.0.1:" + std::to_string(port_); }

  std::atomic<Fault> fault = Fault::none;
  std::atomic<int> requests = 0;

 private:
  void accept() {
    while (!is_stopped_) {
      const int connection = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection < 0) continue;
      const std::lock_guard lock(mutex_);
      open_.push_back(connection);
      serving_.emplace_back([this, connection] { serve(connection); });
    }
  }

  void serve(int connection) {
    std::string text;
    while (!is_stopped_) {
      const size_t end = text.find("\r\n\r\n");
      if (end == std::string::npos) {
        char buffer[4096];
        const ssize_t got = ::recv(connection, buffer, sizeof buffer, 0);
        if (got <= 0) break;
        text.append(buffer, static_cast<size_t>(got));
        continue;
      }
      ++requests;
      if (!answer(connection, text.substr(0, end))) break;
      text.erase(0, end + 4);
    }
    const std::lock_guard lock(mutex_);
    open_.erase(std::find(open_.begin(), open_.end(), connection));
    ::close(connection);
  }

  static bool send(int connection, const std::string& text) {
    for (size_t done = 0; done < text.size();) {
      const ssize_t sent = ::send(connection, text.data() + done, text.size() - done, MSG_NOSIGNAL);
      if (sent <= 0) return false;
      done += static_cast<size_t>(sent);
    }
    return true;
  }

  static std::string head(int status, size_t bytes, const std::string& more = {}) {
    return "HTTP/1.1 " + std::to_string(status) + " so\r\nContent-Length: " + std::to_string(bytes) + "\r\n" + more +
           "\r\n";
  }

  /// Answers a request. Returns whether the connection stays open.
  bool answer(int connection, const std::string& request) {
    const Fault wrong = fault;
    if (wrong == Fault::hangs_up) return false;
    if (wrong == Fault::is_silent) {
      char byte;
      while (::recv(connection, &byte, 1, 0) > 0) {
      }
      return false;
    }
    if (wrong == Fault::fails) return send(connection, head(503, 0));
    if (wrong == Fault::refuses) return send(connection, head(403, 6) + "denied");
    const size_t path = request.find(' ') + 1;
    std::ifstream file(root_ / request.substr(path + 1, request.find(' ', path) - path - 1), std::ios::binary);
    if (!file) return send(connection, head(404, 0));
    const std::string all((std::istreambuf_iterator<char>(file)), {});
    const size_t range = request.find("Range: bytes=");
    if (wrong == Fault::no_ranges || range == std::string::npos) return send(connection, head(200, all.size()) + all);
    size_t dash = 0;
    const std::string wanted = request.substr(range + 13);
    size_t first = std::stoull(wanted, &dash);
    const size_t last = std::min<size_t>(std::stoull(wanted.substr(dash + 1)), all.size() - 1);
    if (first >= all.size()) return send(connection, head(416, 0));
    std::string body = all.substr(first, last - first + 1);
    const size_t bytes = body.size();
    if (wrong == Fault::other_range) first += 1;
    if (wrong == Fault::damaged) {
      for (size_t i = 0; i < body.size(); i += 7) body[i] = static_cast<char>(body[i] ^ 8);
    }
    const std::string more = "Content-Range: bytes " + std::to_string(first) + "-" + std::to_string(first + bytes - 1) +
                             "/" + std::to_string(all.size()) + "\r\n";
    if (wrong == Fault::cut_off) {
      send(connection, head(206, bytes, more) + body.substr(0, bytes / 2));
      return false;
    }
    if (wrong == Fault::endless) body.append(body.size() + 1000, 'x');
    return send(connection, head(206, body.size(), more) + body);
  }

  const std::filesystem::path root_;
  int listener_ = -1;
  uint16_t port_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::thread accepting_;
  std::mutex mutex_;  ///< protects the members below until all threads have ended
  std::vector<int> open_;
  std::vector<std::thread> serving_;
};

}  // namespace sgm
