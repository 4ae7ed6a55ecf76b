#pragma once
// Resource usage of this process, under the names that Prometheus' own clients use. Each system has one source file
// that implements this header.

#include <cstdint>
#include <optional>

namespace sgm::platform {

/// A figure that the system does not provide is nullopt.
struct ProcessFigures {
  std::optional<uint64_t> resident_bytes;
  std::optional<double> cpu_seconds;    ///< user and system time of all threads since the process started
  std::optional<double> start_seconds;  ///< time of the process's start, seconds since 1970
  std::optional<uint64_t> open_files;
};

/// Reads the current figures. Takes some ten microseconds. Throws std::bad_alloc.
ProcessFigures processFigures();

}  // namespace sgm::platform
