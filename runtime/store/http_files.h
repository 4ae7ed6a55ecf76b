#pragma once
// Stores on static file servers. Any server that answers range requests (RFC 9110, section 14) works.

#include "store/store_files.h"

namespace sgm::store {

/// The files below an address without query and fragment. No request is sent before a file is opened. Data is read in
/// blocks of 128 KiB; the latest 32 MiB are cached, since neighbouring chunks are adjacent in a pack. If a server does
/// not answer, that is logged once, and it gets no requests for a while (outage.h); meanwhile all calls return busy at
/// once. A file that could not be read is not requested again for a minute. With a very slow server a reader waits at
/// most about twelve seconds; after stop(), one second.
Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory);

}  // namespace sgm::store
