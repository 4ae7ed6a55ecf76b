#pragma once
// Parses the output of an inspecting process, which has read untrusted input and is not trusted either.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/platform/process.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// Limit of its standard output: uint64 size of the JSON, the JSON, uint64 size of the preview, the preview;
/// little-endian.
inline constexpr size_t kMostAnswer = size_t{32} << 20;
/// Limit of a report's JSON, which is kept.
inline constexpr size_t kMostReportText = size_t{2} << 20;

enum class Answer { report, masters };

/// If the output is not valid, returns a problem of status 500 that tells how the process ended.
Inspection inspectionOf(const platform::ProcessOutput& said, std::chrono::seconds time, Answer wanted);

/// RFC 9457. code: for programs. detail: for users, with the remedy; invalid UTF-8 in it is replaced.
Inspection problemOf(int status, std::string_view code, std::string_view detail);
/// 503: the service is stopping.
Inspection stoppedProblem();
/// 500: this process is out of memory. Its JSON is empty if there is no memory for it: call it in advance.
Inspection outOfMemoryProblem() noexcept;

}  // namespace sgm::service
