#pragma once
// Combines stores as the source of a streamed world.

#include <span>

#include "store/cache/baked_parts.h"
#include "store/store_files.h"

namespace sgm::store {

/// Returns each part from the first store that has it, folders before servers. places: as in storeFiles(). A world's
/// index is found by its identity at the first query; so a store without data of the world costs nothing, and a server
/// gets no earlier request. A faulty file is reported and loses only its own content, which is derived instead. It is
/// reported once if no store has data of a world. A server is treated the same if this build or machine cannot read
/// from servers. memory must be thread-safe and outlive the source. io, bad_input: a folder is not a store of this
/// version, or an address is invalid; unsupported: as available().
Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::string> places, Log log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
