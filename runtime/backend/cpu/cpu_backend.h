#pragma once
// Meshes chunks on the threads of the job system, one chunk at a time on each thread.

#include <string_view>

#include "backend/backend.h"

namespace sgm {

/// Creates a CPU backend. instruction_set: a name of findKernels(), or empty for the widest. Error: unsupported if this
/// build does not contain the instruction set, or the processor does not support it.
Result<std::unique_ptr<Backend>> makeCpuBackend(std::string_view instruction_set, JobSystem& jobs,
                                                std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm
