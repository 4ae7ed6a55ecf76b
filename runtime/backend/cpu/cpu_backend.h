#pragma once
// Chunks on the job system's threads, one job a chunk.

#include <string_view>

#include "backend/backend.h"

namespace sgm {

/// unsupported: no such instruction set in this build, or this processor does not run it.
Result<std::unique_ptr<Backend>> makeCpuBackend(std::string_view instruction_set, JobSystem& jobs,
                                                std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
