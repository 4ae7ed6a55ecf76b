#pragma once
// A replacement of the program's operator new that counts its calls.

namespace sgm::vulkan {

/// Number of calls of operator new on this thread so far.
int allocationsOfThread();

}  // namespace sgm::vulkan
