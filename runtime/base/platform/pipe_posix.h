#pragma once
// Pipes on POSIX systems, used only by process_posix.cpp and process_exchange_posix.cpp.

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <utility>

#include "base/plain_text.h"
#include "base/platform/file.h"
#include "base/result.h"

namespace sgm::platform {

/// A pipe or a socket pair: bytes written to `to` are read from `from`. Child processes do not inherit the descriptors.
struct Pipe {
  File from, to;
};

inline Error ioError(const char* what) { return {Code::io, std::string(what) + ": " + systemMessage(errno)}; }

/// Moves a descriptor away from the numbers 0 to 2, which a child process uses for its standard streams. New
/// descriptors get these numbers if this process has closed its own standard streams. Error: io, if the descriptor is
/// invalid.
inline Result<File> clearOfStreams(File file) {
  constexpr int kFirstFree = 3;
  if (file.number() >= kFirstFree) return file;
  File moved(file ? fcntl(file.number(), F_DUPFD_CLOEXEC, kFirstFree) : -1);
  if (!moved) return ioError("cannot open a descriptor");
  return moved;
}

inline Result<Pipe> clearOfStreams(const std::array<int, 2>& ends) {
  File first(ends[0]), second(ends[1]);
  Result<File> from = clearOfStreams(std::move(first)), to = clearOfStreams(std::move(second));
  if (!from) return from.error();
  if (!to) return to.error();
  return Pipe{std::move(*from), std::move(*to)};
}

inline Result<Pipe> openPipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return ioError("cannot open a pipe");
  return clearOfStreams(ends);
}

/// Opens a socket pair instead of a pipe. If the reader has closed its end, a write to a pipe raises SIGPIPE; a write
/// to a socket with MSG_NOSIGNAL only returns an error.
inline Result<Pipe> openSocket() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return ioError("cannot open a socket");
  return clearOfStreams(ends);
}

}  // namespace sgm::platform
