#pragma once
// Counts the bytes of existing surfaces, and frees surfaces on jobs instead of the engine's thread.
//
// An engine may release many meshes in one frame, and freeing hundreds of arrays would take noticeable time. So
// releasing the last reference only adds the surface to a list, which the world's jobs empty.

#include <atomic>
#include <memory>
#include <memory_resource>

#include "chunk/chunk_surface.h"

namespace sgm {

/// Owns surfaces. A reference to a surface keeps the pool alive. Thread-safe.
class SurfacePool : public std::enable_shared_from_this<SurfacePool> {
 public:
  explicit SurfacePool(std::pmr::memory_resource* memory) : memory_(memory) {}
  ~SurfacePool() { collect(); }

  /// Takes ownership of a surface, and returns a reference to it. Throws std::bad_alloc.
  std::shared_ptr<const ChunkSurface> add(ChunkSurface&& surface);

  /// Frees the surfaces without references, and returns their number.
  size_t collect();
  /// Call this when collect() will not be called any more: from now on, releasing the last reference frees a surface
  /// immediately.
  void close();

  /// total size in bytes of all surfaces that are not freed yet
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
