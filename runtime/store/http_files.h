#pragma once
// Stores on servers of plain files: any that answers range requests (RFC 9110, section 14), nothing of it is ours.

#include "store/store_files.h"

namespace sgm::store {

/// Whether it begins as one of a server.
inline bool isAddress(const std::string& place) {
  return place.rfind("http://", 0) == 0 || place.rfind("https://", 0) == 0;
}

/// The files below an address, which has neither query nor fragment. Nothing is asked before a file is opened. What is
/// read is read in blocks of 256 KiB, the latest 32 MiB of which are kept: chunks that lie side by side in the world do
/// so in a pack. A server that does not answer is told of once, and left alone for a second, then for two, for a minute
/// at most; until then all is busy at once. Nobody waits for longer than some seconds, or after stop.
Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory);

}  // namespace sgm::store
