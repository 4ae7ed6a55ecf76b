#pragma once
// Parses the output of `sgm inspect`. The output is not trusted, since that process has read untrusted input.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/platform/process.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// Limit of a process's standard output, which consists of the size of the JSON (uint64), the JSON, the size of the
/// preview (uint64), and the preview; little-endian.
inline constexpr size_t kMaxAnswer = size_t{32} << 20;
/// Limit of a report's JSON, since reports stay in memory.
inline constexpr size_t kMaxReportText = size_t{2} << 20;

enum class Answer { report, masters };

/// The inspection's result from a process's output. If the output is invalid, a problem with status 500 that says how
/// the process ended.
Inspection inspectionOf(const platform::ProcessOutput& said, std::chrono::seconds time, Answer wanted);

/// Makes a problem (RFC 9457). code: identifier for programs. detail: explanation for users, with the remedy; invalid
/// UTF-8 is replaced.
Inspection problemOf(int status, std::string_view code, std::string_view detail);
/// The problem with status 503 that tells that the service is stopping.
Inspection stoppedProblem();
/// The problem with status 500 that tells that the service is out of memory. Its JSON is empty if there is no memory
/// for it, so it should be made in advance.
Inspection outOfMemoryProblem() noexcept;

}  // namespace sgm::service
