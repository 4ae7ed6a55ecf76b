#pragma once
// Combines several stores into one source of baked parts for a streamed world.

#include <span>

#include "store/cache/baked_parts.h"
#include "store/store_files.h"

namespace sgm::store {

/// Opens a source that returns each part from the first store that has it; folders are searched before servers. places:
/// paths and addresses as for storeFiles(). The index of a world is searched at the first query for that world: a store
/// that does not have the world costs nothing, and a server gets no earlier request. A faulty file is reported; the
/// content of the file is derived instead. If no store has a world, that is reported once. If this build or machine
/// cannot read from servers, that is reported, and servers are ignored. memory must be thread-safe and outlive the
/// source. Errors: io and bad_input if a folder is not a store of this version, or an address is invalid; unsupported
/// as available().
Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::string> places, Log log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
