#pragma once
// How urgent the parts are that work is shared out in.

namespace sgm {

/// For JobSystem::submit(), of a part of something that a thread waits for, which does itself what nobody else begins.
/// No less urgent than any other job that comes all the time: a part that comes too late does nothing, but it holds
/// memory until it has run.
inline constexpr int kSharePriority = 1;

}  // namespace sgm
