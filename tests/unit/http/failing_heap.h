#pragma once
// A replacement of the program's operator new that fails on request.

namespace sgm {

/// Makes allocations fail after this many more on all threads that are not spared: only the next one, or, if for_good,
/// all from then on.
void failHeap(long after, bool for_good);
/// Ends the failures. Returns whether an allocation has failed.
bool mendHeap();
/// Exempts the calling thread from failures, permanently.
void spareThisThread();

}  // namespace sgm
