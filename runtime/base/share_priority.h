#pragma once
// The priority of jobs that share a loop or batch with a thread that waits for all of it.

namespace sgm {

/// The priority, for JobSystem::submit(), of jobs that take over parts of a loop or batch for a waiting thread. The
/// waiting thread itself does the parts that no job has begun. No frequent kind of job has a higher priority: a job
/// that starts too late finds no work left, but holds memory until it has run.
inline constexpr int kSharePriority = 1;

}  // namespace sgm
