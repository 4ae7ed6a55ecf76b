#pragma once
// An HTTP/1.1 server on one port. One thread serves all clients, so a slow client costs only a few kilobytes of memory.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/service/http/handler.h"

namespace sgm::service::http {

struct ServerSettings {
  std::string address = "127.0.0.1";  ///< numeric IPv4 or IPv6 address to listen on
  uint16_t port = 0;                  ///< port to listen on; 0: any free port
  std::string thread_name = "http";   ///< name of the server's thread, for debuggers; at most 15 bytes
  /// Maximum number of concurrent connections; further clients get a 503. If the process has no file descriptor left,
  /// further clients are closed without an answer.
  uint32_t connections = 2048;
  size_t line_bytes = 8192;   ///< maximum length in bytes of the request line and of each header
  size_t head_bytes = 32768;  ///< maximum size in bytes of a request's head (request line and all headers)
  size_t fields = 64;
  std::chrono::milliseconds head_time{10000};  ///< maximum time from the first byte of a head to its end
  std::chrono::milliseconds body_time{30000};  ///< maximum time from the end of the head to the end of the body
  /// Maximum time that a connection waits for its first or next request.
  std::chrono::milliseconds idle_time{15000};
  std::chrono::milliseconds work_time{600000};  ///< maximum time for the handler to answer; the client then gets a 503
  std::chrono::milliseconds write_time{30000};  ///< maximum time for a client to receive its answer
  /// Limit in bytes of the memory of all answers that clients have not received yet. A body that several answers share
  /// counts once; bodies below 4 KiB do not count. An answer that would exceed the limit is replaced by a 503. A single
  /// body of any size is accepted if no other body is counted.
  uint64_t unsent_bytes = uint64_t{64} << 20;
  /// Time for the client to close the connection after the last answer. Meanwhile the server reads and discards up to
  /// drain_bytes. If the server closed the connection at once, the client would see a reset instead of the answer.
  std::chrono::milliseconds drain_time{5000};
  uint64_t drain_bytes = uint64_t{16} << 20;
};

/// A value for ServerSettings::connections: the process's current limit of open files (RLIMIT_NOFILE) divided by
/// `share`, clamped to 8..most.
uint32_t connectionsWithin(uint32_t most, uint32_t share);

struct ServerCounts {
  uint64_t connections = 0;  ///< current number of open connections
  uint64_t accepted = 0;     ///< number of accepted connections since the start, without rejected clients
  /// Number of clients rejected since the start, because of ServerSettings::connections or for lack of a file
  /// descriptor.
  uint64_t turned_away = 0;
  std::array<uint64_t, 600> answers{};  ///< number of answers since the start, indexed by status
};

class Server {
 public:
  /// Starts to listen and answer. Contract: handler outlives the server. Errors: invalid_argument if the address is not
  /// numeric; io if the server cannot listen there (address in use, not of this machine, no permission).
  static Result<std::unique_ptr<Server>> start(const ServerSettings& settings, Handler& handler);
  /// Same as stop(0).
  virtual ~Server() = default;

  virtual uint16_t port() const = 0;
  /// Thread-safe, and does not block the server's thread.
  virtual ServerCounts counts() const = 0;
  /// Stops listening, waits up to `grace` until all requests whose head has arrived are answered, and closes all
  /// connections. Blocks. A Reply that is called after stop() has no effect. Must not be called on the server's own
  /// thread.
  virtual void stop(std::chrono::milliseconds grace) = 0;
};

}  // namespace sgm::service::http
