#pragma once
// Counts the bytes of living surfaces, and frees them outside of the engine's thread.
//
// An engine releases a mesh at its own point of the frame, where freeing hundreds of arrays would be noticeable. The
// last owner only puts the surface on a list, which the world's jobs empty.

#include <atomic>
#include <memory>
#include <memory_resource>

#include "chunk/chunk_surface.h"

namespace sgm {

/// Thread-safe. Lives as long as its last surface.
class SurfacePool : public std::enable_shared_from_this<SurfacePool> {
 public:
  explicit SurfacePool(std::pmr::memory_resource* memory) : memory_(memory) {}
  ~SurfacePool() { collect(); }

  /// Throws std::bad_alloc.
  std::shared_ptr<const ChunkSurface> add(ChunkSurface&& surface);

  /// Frees surfaces without an owner. Returns their number.
  size_t collect();
  /// Announces that collect() will not be called any more: from now on the last owner frees.
  void close();

  size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }  ///< of all surfaces that are not freed
  size_t peakBytes() const { return peak_bytes_.load(std::memory_order_relaxed); }

 private:
  struct Node {
    ChunkSurface surface;
    size_t bytes;
    Node* next = nullptr;
  };
  void letGo(Node* node) noexcept;
  void free(Node* node) noexcept;

  std::pmr::memory_resource* memory_;
  std::atomic<Node*> unowned_{nullptr};
  std::atomic<bool> closed_{false};
  std::atomic<size_t> bytes_{0}, peak_bytes_{0};
};

}  // namespace sgm
