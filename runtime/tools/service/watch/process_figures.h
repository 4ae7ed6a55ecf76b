#pragma once
// What the process takes of its machine, by the names that Prometheus' own clients have for it.

#include <cstdint>
#include <optional>

namespace sgm::service {

/// What cannot be read is not there.
struct ProcessFigures {
  std::optional<uint64_t> resident_bytes;
  std::optional<double> cpu_seconds;    ///< of all threads since its start, in it and in the system for it
  std::optional<double> start_seconds;  ///< seconds since 1970
  std::optional<uint64_t> open_files;
};

/// Some ten microseconds. Throws std::bad_alloc.
ProcessFigures processFigures();

}  // namespace sgm::service
