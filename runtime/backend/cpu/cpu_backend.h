#pragma once
// Meshes chunks on the job system's threads, one job a chunk.

#include <string_view>

#include "backend/backend.h"

namespace sgm {

/// unsupported: this build has no such instruction set, or this processor does not support it.
Result<std::unique_ptr<Backend>> makeCpuBackend(std::string_view instruction_set, JobSystem& jobs,
                                                std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
