#pragma once
// Counts the bytes of existing surfaces, and frees surfaces outside of the engine's thread.
//
// An engine releases a mesh at some point of its frame, where freeing hundreds of arrays would take noticeable time. So
// the last owner only puts the surface on a list, and the world's jobs free the surfaces on the list.

#include <atomic>
#include <memory>
#include <memory_resource>

#include "chunk/chunk_surface.h"

namespace sgm {

/// Thread-safe. Exists as long as its last surface.
class SurfacePool : public std::enable_shared_from_this<SurfacePool> {
 public:
  explicit SurfacePool(std::pmr::memory_resource* memory) : memory_(memory) {}
  ~SurfacePool() { collect(); }

  /// Takes ownership of a surface. Throws std::bad_alloc.
  std::shared_ptr<const ChunkSurface> add(ChunkSurface&& surface);

  /// Frees the surfaces that have no owner any more. Returns their number.
  size_t collect();
  /// Announces that collect() will not be called any more: from now on, the last owner frees a surface itself.
  void close();

  /// total size of all surfaces that are not freed yet
  size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
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
