#pragma once
// Changes a store that other processes may be changing.

#include <fmt/core.h>

#include <chrono>

#include "store/folder.h"

namespace sgm::cli {

/// Calls change(patience) with patience 0; if another process holds the store, says so and waits for its turn.
template <class Change>
auto inTurn(const store::Folder& store, const Change& change) {
  auto changed = change(std::chrono::milliseconds(0));
  if (changed || changed.error().code != Code::busy) return changed;
  fmt::print(stderr, "sgm: another process is merging into '{}' or cleaning it: waiting for it, {} minutes at most\n",
             store.root().string(), store::StoreLock::kPatience.count());
  return change(store::StoreLock::kPatience);
}

}  // namespace sgm::cli
