#pragma once
// Combines several stores into one source of baked parts for a streamed world.

#include <span>

#include "store/cache/baked_parts.h"
#include "store/store_files.h"

namespace sgm::store {

/// Opens a source that returns each part from the first store that has the part; folders are searched before servers.
/// places: paths or URLs, as for storeFiles(). The index of a world is read at the first query for this world; until
/// then no request is sent to a server. An error in a file is logged, and the affected chunks are derived instead. If
/// no store has a world, this is logged once. If this build or machine cannot read from servers, this is logged, and
/// servers are ignored. memory must be thread-safe and outlive the source. Errors: io and bad_input if a folder is not
/// a store of this version, or a URL is invalid; unsupported if the build lacks zstd and xxHash (available()).
Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::string> places, Log log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
