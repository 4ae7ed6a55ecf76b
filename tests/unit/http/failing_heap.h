#pragma once
// The program's operator new fails where it is told to.

namespace sgm {

/// After so many more allocations, of all threads that are not spared: the next one, or all from then on.
void failHeap(long after, bool for_good);
/// No more fail. Has one?
bool mendHeap();
/// The calling thread has all the memory that it wants, for good.
void spareThisThread();

}  // namespace sgm
