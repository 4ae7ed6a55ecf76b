#pragma once
// Stores as what a world streams from.

#include <filesystem>
#include <functional>
#include <span>

#include "store/frames.h"
#include "stream/baked_parts.h"

namespace sgm::store {

/// Told of what is wrong with a store, once for each file. Any thread.
using Log = std::function<void(const std::string&)>;

/// The parts of the first store that has them. A world finds its own index by its identity, when it first asks; so a
/// store that has none of it costs nothing. What is wrong with a file is told and costs what lies in it, no more: who
/// asks derives it. memory, thread-safe, must outlive the source.
/// io, bad_input: a folder is no store of this version; unsupported: as available().
Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::filesystem::path> folders, Log log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
