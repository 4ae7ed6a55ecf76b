#pragma once
// How a command changes a store that other processes may be changing.

#include <fmt/core.h>

#include <chrono>

#include "store/folder.h"

namespace sgm::cli {

/// change(patience), at once; where another process has the store, says so and does it when its turn comes.
template <class Change>
auto inTurn(const store::Folder& store, const Change& change) {
  auto changed = change(std::chrono::milliseconds(0));
  if (changed || changed.error().code != Code::busy) return changed;
  fmt::print(stderr, "sgm: another process merges into '{}', or cleans it: waiting for it, {} minutes at most\n",
             store.root().string(), store::StoreLock::kPatience.count());
  return change(store::StoreLock::kPatience);
}

}  // namespace sgm::cli
