#pragma once
// A replacement of the program's operator new that fails on request.

namespace sgm {

/// Makes allocations fail after `after` more allocations: only the next one, or, if for_good, all from then on.
/// Allocations of threads that called spareThisThread() neither count nor fail.
void failHeap(long after, bool for_good);
/// Ends the failures. Returns whether any allocation has failed.
bool mendHeap();
/// Exempts the calling thread from failures, permanently.
void spareThisThread();

}  // namespace sgm
