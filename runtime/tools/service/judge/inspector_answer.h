#pragma once
// What a process that inspects has said, taken apart: it has read what came from outside, and is believed as little.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "tools/service/judge/child_process.h"
#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// On its standard output: uint64 size of the JSON, the JSON, uint64 size of the preview, the preview; little-endian.
inline constexpr size_t kMostAnswer = size_t{32} << 20;
/// Of the JSON of a report, which is kept.
inline constexpr size_t kMostReportText = size_t{2} << 20;

enum class Answer { report, masters };

/// With how the process ended, which a problem of status 500 tells of where it has not said anything sound.
Inspection inspectionOf(ChildOutcome outcome, std::chrono::seconds time, Answer wanted);

/// RFC 9457. code: for programs. detail: for people, what to do; what is no UTF-8 in it is replaced.
Inspection problemOf(int status, std::string_view code, std::string_view detail);
/// 503: the service ends.
Inspection stoppedProblem();
/// 500: this process has no memory left. Its JSON is empty where there is none for that either: make it beforehand.
Inspection outOfMemoryProblem() noexcept;

}  // namespace sgm::service
