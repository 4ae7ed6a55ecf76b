#pragma once
// Changes a store that other processes may be changing at the same time.

#include <fmt/core.h>

#include <chrono>

#include "store/folder.h"

namespace sgm::cli {

/// Calls change(0 ms); the argument is the maximum time to wait for the store's lock. If another process holds the
/// lock, prints a notice and calls change again with a longer time.
template <class Change>
auto inTurn(const store::Folder& store, const Change& change) {
  auto changed = change(std::chrono::milliseconds(0));
  if (changed || changed.error().code != Code::busy) return changed;
  fmt::print(stderr, "sgm: another process is merging into '{}' or cleaning it: waiting for it, {} minutes at most\n",
             store.root().string(), store::StoreLock::kPatience.count());
  return change(store::StoreLock::kPatience);
}

}  // namespace sgm::cli
