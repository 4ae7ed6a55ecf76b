#pragma once
// HTTP/1.1 on one port, with one thread for all its clients: a slow one holds a few kilobytes and nothing else.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/service/http/handler.h"

namespace sgm::service::http {

struct ServerSettings {
  std::string address = "127.0.0.1";  ///< an IPv4 or IPv6 address in numbers
  uint16_t port = 0;                  ///< 0: any that is free
  std::string thread_name = "http";   ///< as debuggers show it, 15 bytes at most
  /// At one time; those beyond have a 503 and are closed. Where the process may not open so many files, further clients
  /// are closed at once.
  uint32_t connections = 2048;
  size_t line_bytes = 8192;   ///< of the request line, and of each field
  size_t head_bytes = 32768;  ///< of the whole head
  size_t fields = 64;
  std::chrono::milliseconds head_time{10000};   ///< from the first byte to the end of the head
  std::chrono::milliseconds body_time{30000};   ///< from the end of the head to that of the body
  std::chrono::milliseconds idle_time{15000};   ///< between requests of a connection, and before its first byte
  std::chrono::milliseconds work_time{600000};  ///< for the handler to reply; then the client has a 503
  std::chrono::milliseconds write_time{30000};  ///< for a client to take its answer
  /// Of answers that clients have not taken yet, all together; a body that several share counts once, and bodies below
  /// 4 KiB do not. An answer beyond it is replaced by a 503; one alone may be larger.
  uint64_t unsent_bytes = uint64_t{64} << 20;
  /// Behind the last answer of a connection, for the client to close it: until then what it still sends is read and
  /// thrown away, up to so many bytes. Closed at once, it would see a reset rather than why it was refused.
  std::chrono::milliseconds drain_time{5000};
  uint64_t drain_bytes = uint64_t{16} << 20;
};

/// For ServerSettings::connections: `most`, or what the process may open of files (RLIMIT_NOFILE, as it is now) divided
/// by `share`, whichever is less; at least 8.
uint32_t connectionsWithin(uint32_t most, uint32_t share);

struct ServerCounts {
  uint64_t connections = 0;             ///< now
  uint64_t accepted = 0;                ///< since the start, without those turned away
  uint64_t turned_away = 0;             ///< beyond ServerSettings::connections, or for want of a file descriptor
  std::array<uint64_t, 600> answers{};  ///< by status
};

class Server {
 public:
  /// Listens, and answers from then on. handler must outlive the server. Errors: invalid_argument for an address that
  /// is none; io where it cannot be listened on (the message says why: in use, not this machine's, no permission).
  static Result<std::unique_ptr<Server>> start(const ServerSettings& settings, Handler& handler);
  /// As stop() without any time.
  virtual ~Server() = default;

  virtual uint16_t port() const = 0;
  /// From any thread; the server never waits for it.
  virtual ServerCounts counts() const = 0;
  /// Listens no more, lets requests whose head was read be answered within that time, then closes what is left. Blocks.
  /// Replies that come later do nothing. Not from the server's own thread.
  virtual void stop(std::chrono::milliseconds grace) = 0;
};

}  // namespace sgm::service::http
