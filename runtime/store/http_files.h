#pragma once
// Reads stores from static file servers over HTTP. Any server that answers range requests (RFC 9110, section 14) works.

#include "store/store_files.h"

namespace sgm::store {

/// Gives access to the files of a store at a URL without query and fragment. No request is sent before a file is
/// opened. Data is read in blocks of 128 KiB, of which the most recently used 32 MiB are cached, because neighbouring
/// chunks lie next to each other in a file. If the server does not answer, this is logged once, and no requests are
/// sent for a while (outage.h); in the meantime all calls return busy immediately. A file that could not be read is not
/// requested again for a minute. With a very slow server a call takes at most about twelve seconds; after stop(), one
/// second.
Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory);

}  // namespace sgm::store
