#pragma once
// Stores as what a world streams from.

#include <span>

#include "store/cache/baked_parts.h"
#include "store/store_files.h"

namespace sgm::store {

/// The parts of the first store that has them, folders before servers. places: as storeFiles takes them. A world finds
/// its own index by its identity, when it first asks; so a store that has none of it costs nothing, and a server is
/// asked for nothing before. What is wrong with a file is told and costs what lies in it, no more: who asks derives it;
/// that no store has anything of a world is told once. memory, thread-safe, must outlive the source. A server costs no
/// more than that either where this build, or machine, can read from none. io, bad_input: a folder is no store of this
/// version, an address is none; unsupported: as available().
Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::string> places, Log log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
