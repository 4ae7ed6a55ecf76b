#pragma once
// Stores on static file servers. Any server that answers range requests (RFC 9110, section 14) works.

#include "store/store_files.h"

namespace sgm::store {

/// Gives access to the files below an address, which has no query and no fragment. No request is sent before a file is
/// opened. Data is read in blocks of 128 KiB, and the latest 32 MiB are cached, because adjacent chunks lie next to
/// each other in a pack. If a server does not answer, that is logged once, and no requests are sent for a while
/// (outage.h); meanwhile all calls return busy at once. A file that could not be read is not requested again for a
/// minute. With a very slow server a caller waits at most about twelve seconds; after stop(), one second.
Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory);

}  // namespace sgm::store
