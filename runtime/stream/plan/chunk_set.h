#pragma once
// A hash set of chunk keys, for the split nodes of an octree. A plan looks up some hundred thousand keys; with
// std::unordered_set, lookups took two thirds of the plan's time.

#include <algorithm>
#include <vector>

#include "world/chunk_key.h"

namespace sgm {

/// A hash set with open addressing and linear probing. At most half of its slots are used.
class ChunkSet {
 public:
  bool contains(const ChunkKey& key) const {
    if (keys_.empty()) return false;
    for (size_t i = home(key);; i = next(i)) {
      if (keys_[i].level == kFree) return false;
      if (keys_[i] == key) return true;
    }
  }

  /// Inserts a key; returns true if it is new. Precondition: its level is not negative.
  bool insert(const ChunkKey& key) {
    if (2 * (size_ + 1) > keys_.size()) grow();
    for (size_t i = home(key);; i = next(i)) {
      if (keys_[i] == key) return false;
      if (keys_[i].level != kFree) continue;
      keys_[i] = key;
      ++size_;
      return true;
    }
  }

  /// Removes a key; returns true if it was present.
  bool erase(const ChunkKey& key) {
    if (!contains(key)) return false;
    size_t hole = home(key);
    while (keys_[hole] != key) hole = next(hole);
    // Moves later entries of the probe sequence into the free slot, so that lookups do not end there too early.
    for (size_t i = next(hole); keys_[i].level != kFree; i = next(i)) {
      const size_t from_home = (i - home(keys_[i])) & (keys_.size() - 1);
      const size_t from_hole = (i - hole) & (keys_.size() - 1);
      if (from_home < from_hole) continue;
      keys_[hole] = keys_[i];
      hole = i;
    }
    keys_[hole].level = kFree;
    --size_;
    return true;
  }

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }

  /// Returns all keys in unspecified order; no result of a plan may depend on this order.
  std::vector<ChunkKey> unordered() const {
    std::vector<ChunkKey> found;
    found.reserve(size_);
    for (const ChunkKey& key : keys_) {
      if (key.level != kFree) found.push_back(key);
    }
    return found;
  }

  friend bool operator==(const ChunkSet& a, const ChunkSet& b) {
    if (a.size_ != b.size_) return false;
    for (const ChunkKey& key : a.keys_) {
      if (key.level != kFree && !b.contains(key)) return false;
    }
    return true;
  }

 private:
  static constexpr int kFree = -1;

  size_t home(const ChunkKey& key) const { return ChunkKeyHash{}(key) & (keys_.size() - 1); }
  size_t next(size_t i) const { return (i + 1) & (keys_.size() - 1); }
  void grow() {
    std::vector<ChunkKey> old(std::max<size_t>(16, 2 * keys_.size()), ChunkKey{kFree, {}});
    old.swap(keys_);
    size_ = 0;
    for (const ChunkKey& key : old) {
      if (key.level != kFree) insert(key);
    }
  }

  std::vector<ChunkKey> keys_;  ///< slots of the hash table; their number is a power of two
  size_t size_ = 0;
};

}  // namespace sgm
