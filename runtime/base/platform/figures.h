#pragma once
// Resource usage of this process, with the meanings of Prometheus' standard process metrics. Each operating system has
// one source file that implements this header.

#include <cstdint>
#include <optional>

namespace sgm::platform {

/// Resource usage of this process; a value is nullopt if the operating system does not provide it.
struct ProcessFigures {
  std::optional<uint64_t> resident_bytes;
  std::optional<double> cpu_seconds;    ///< processor time in user and kernel mode, summed over all threads since the
                                        ///< process started
  std::optional<double> start_seconds;  ///< time when the process started, in seconds since 1970
  std::optional<uint64_t> open_files;
};

/// Reads the current values, which takes about ten microseconds. Throws std::bad_alloc.
ProcessFigures processFigures();

}  // namespace sgm::platform
