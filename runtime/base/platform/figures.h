#pragma once
// Resource usage of this process, under the names that Prometheus' own clients use. Each system has one source file
// that implements this header.

#include <cstdint>
#include <optional>

namespace sgm::platform {

/// Unreadable figures are nullopt.
struct ProcessFigures {
  std::optional<uint64_t> resident_bytes;
  std::optional<double> cpu_seconds;    ///< of all threads since the start, user and system time
  std::optional<double> start_seconds;  ///< seconds since 1970
  std::optional<uint64_t> open_files;
};

/// Takes some ten microseconds. Throws std::bad_alloc.
ProcessFigures processFigures();

}  // namespace sgm::platform
