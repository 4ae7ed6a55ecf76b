#pragma once
// An HTTP/1.1 server on one port. One thread serves all clients: a slow client costs only a few kilobytes.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/service/http/handler.h"

namespace sgm::service::http {

struct ServerSettings {
  std::string address = "127.0.0.1";  ///< a numeric IPv4 or IPv6 address
  uint16_t port = 0;                  ///< 0: any free port
  std::string thread_name = "http";   ///< name of the server's thread in debuggers, at most 15 bytes
  /// Maximum number of concurrent connections; further clients get a 503 and are closed. If the process cannot open
  /// more files, further clients are closed without an answer.
  uint32_t connections = 2048;
  size_t line_bytes = 8192;   ///< limit of the request line, and of each field
  size_t head_bytes = 32768;  ///< limit of a request's whole head
  size_t fields = 64;
  std::chrono::milliseconds head_time{10000};  ///< limit from the first byte to the end of the head
  std::chrono::milliseconds body_time{30000};  ///< limit from the end of the head to the end of the body
  /// Limit between two requests of a connection, and before its first byte.
  std::chrono::milliseconds idle_time{15000};
  std::chrono::milliseconds work_time{600000};  ///< limit for the handler to reply; afterwards the client gets a 503
  std::chrono::milliseconds write_time{30000};  ///< limit for a client to receive its answer
  /// Limit of the bytes of all answers that clients have not yet received; a shared body counts once, bodies below 4
  /// KiB do not count. An answer that would exceed the limit is replaced by a 503, except if no other answer is
  /// counted.
  uint64_t unsent_bytes = uint64_t{64} << 20;
  /// After the last answer of a connection, the time for the client to close it: until then the server reads and
  /// discards up to drain_bytes. If the server closed immediately, the client would see a reset instead of the answer.
  std::chrono::milliseconds drain_time{5000};
  uint64_t drain_bytes = uint64_t{16} << 20;
};

/// The value for ServerSettings::connections: the smaller of `most` and the process's current limit of open files
/// (RLIMIT_NOFILE) divided by `share`, but at least 8.
uint32_t connectionsWithin(uint32_t most, uint32_t share);

struct ServerCounts {
  uint64_t connections = 0;  ///< number of open connections
  uint64_t accepted = 0;     ///< number of connections since the start, without those turned away
  /// Number of clients rejected because of ServerSettings::connections, or for lack of a file descriptor.
  uint64_t turned_away = 0;
  std::array<uint64_t, 600> answers{};  ///< number of answers by status
};

class Server {
 public:
  /// Listens and answers from now on. handler must outlive the server. Errors: invalid_argument for an invalid address;
  /// io with the reason if it cannot listen there (address in use, not of this machine, no permission).
  static Result<std::unique_ptr<Server>> start(const ServerSettings& settings, Handler& handler);
  /// Same as stop(0).
  virtual ~Server() = default;

  virtual uint16_t port() const = 0;
  /// Thread-safe; does not delay the server.
  virtual ServerCounts counts() const = 0;
  /// Stops listening, waits until requests whose head was read are answered, but no longer than `grace`, then closes
  /// all connections. Blocks. Later replies do nothing. Must not be called in the server's own thread.
  virtual void stop(std::chrono::milliseconds grace) = 0;
};

}  // namespace sgm::service::http
