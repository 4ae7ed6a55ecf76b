#pragma once
// Parses the output of `sgm inspect`. That process has read untrusted input, so its output is not trusted either.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/platform/process.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// Limit of the process's standard output: uint64 size of the JSON, the JSON, uint64 size of the preview, the preview;
/// little-endian.
inline constexpr size_t kMaxAnswer = size_t{32} << 20;
/// Limit of a report's JSON, which stays in memory.
inline constexpr size_t kMaxReportText = size_t{2} << 20;

enum class Answer { report, masters };

/// If the output is not valid, returns a problem of status 500 that tells how the process ended.
Inspection inspectionOf(const platform::ProcessOutput& said, std::chrono::seconds time, Answer wanted);

/// Makes a problem as in RFC 9457. code: identifies it for programs. detail: explains it to users, with the remedy;
/// invalid UTF-8 is replaced.
Inspection problemOf(int status, std::string_view code, std::string_view detail);
/// The problem of status 503 if the service is stopping.
Inspection stoppedProblem();
/// The problem of status 500 if this process is out of memory. If there is no memory even for its JSON, the JSON is
/// empty; call this function before memory runs out.
Inspection outOfMemoryProblem() noexcept;

}  // namespace sgm::service
