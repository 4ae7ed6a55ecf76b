#pragma once
// Stores on servers of plain files: any that answers range requests (RFC 9110, section 14), nothing of it is ours.

#include "store/store_files.h"

namespace sgm::store {

/// The files below an address, which has neither query nor fragment. Nothing is asked before a file is opened. What is
/// read is read in blocks of 128 KiB, the latest 32 MiB of which are kept: chunks that lie side by side in the world do
/// so in a pack. A server that does not answer is told of once, and left alone for a while (outage.h); until then all
/// is busy at once. A file that could not be had is not asked for again for a minute. No reader waits for longer than
/// some twelve seconds, for a server that sends very slowly; after stop, one.
Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory);

}  // namespace sgm::store
