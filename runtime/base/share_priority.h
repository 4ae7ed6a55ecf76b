#pragma once
// The priority of jobs that do a part of a loop or batch for a thread that waits for all of it.

namespace sgm {

/// For JobSystem::submit(): the priority of a part of work that a thread waits for. The waiting thread itself does the
/// parts that no other thread has begun. The priority is not below the priority of any frequent job: a part that starts
/// too late finds no work left, but holds memory until it has run.
inline constexpr int kSharePriority = 1;

}  // namespace sgm
