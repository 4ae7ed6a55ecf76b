#pragma once
// The priority of jobs that are parts of a larger work.

namespace sgm {

/// For JobSystem::submit(): the priority of a part of work that a thread waits for. The waiting thread does itself the
/// parts that no other thread has begun. The priority is not below that of any frequent job: a part that runs too late
/// does no work, but holds memory until it has run.
inline constexpr int kSharePriority = 1;

}  // namespace sgm
