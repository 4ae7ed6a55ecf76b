#pragma once
// The program's operator new counts.

namespace sgm::vulkan {

/// Calls of operator new on this thread so far.
int allocationsOfThread();

}  // namespace sgm::vulkan
