#pragma once
// The priority of jobs that do parts of a loop or a batch, while a thread waits for all parts.

namespace sgm {

/// The priority, for JobSystem::submit(), of jobs that do parts of a loop or batch while a thread waits for its end.
/// The waiting thread itself does all parts that no job has begun. So a job that starts too late finds no work left,
/// but holds memory until it has run. Therefore no frequent kind of job has a higher priority.
inline constexpr int kSharePriority = 1;

}  // namespace sgm
