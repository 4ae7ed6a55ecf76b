#include "stream/make/surface_pool.h"

namespace sgm {

std::shared_ptr<const ChunkSurface> SurfacePool::add(ChunkSurface&& surface) {
  std::pmr::polymorphic_allocator<> allocator(memory_);
  const size_t bytes = surface.bytes();
  Node* node = allocator.new_object<Node>(Node{std::move(surface), bytes});
  const size_t live = bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  size_t peak = peak_bytes_.load(std::memory_order_relaxed);
  while (live > peak && !peak_bytes_.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
  }
  // If the allocation of the control block throws, shared_ptr calls the deleter, so the node is not leaked.
  const std::shared_ptr<Node> owner(
      node, [pool = shared_from_this()](Node* unowned) { pool->letGo(unowned); }, allocator);
  return {owner, &owner->surface};
}

void SurfacePool::letGo(Node* node) noexcept {
  if (closed_.load(std::memory_order_acquire)) {
    free(node);
    return;
  }
  node->next = unowned_.load(std::memory_order_relaxed);
  while (!unowned_.compare_exchange_weak(node->next, node, std::memory_order_release, std::memory_order_relaxed)) {
  }
}

size_t SurfacePool::collect() {
  size_t count = 0;
  for (Node* node = unowned_.exchange(nullptr, std::memory_order_acquire); node != nullptr; ++count) {
    Node* const next = node->next;
    free(node);
    node = next;
  }
  return count;
}

void SurfacePool::close() {
  closed_.store(true, std::memory_order_release);
  collect();
}

void SurfacePool::free(Node* node) noexcept {
  bytes_.fetch_sub(node->bytes, std::memory_order_relaxed);
  std::pmr::polymorphic_allocator<>(memory_).delete_object(node);
}

}  // namespace sgm
