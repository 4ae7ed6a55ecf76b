#pragma once
// Where a ray first meets a mesh.

#include <glm/vec3.hpp>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "render/scene.h"

namespace sgm {

struct RayHit {
  float distance = 0;     ///< in lengths of the ray's direction
  bool front = false;     ///< the surface was met from its void side
  uint32_t triangle = 0;  ///< index of the triangle
};

/// A balanced bounding volume tree over triangles, halved along the widest axis. Keeps references to the spans given;
/// many threads may cast at once.
class RayCaster {
 public:
  RayCaster(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
            std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  std::optional<RayHit> cast(glm::vec3 from, glm::vec3 direction, float max_distance) const;

  size_t triangleCount() const { return order_.size(); }
  /// Triangle number i in the tree's order: even steps of i spread evenly over the mesh. i < triangleCount().
  uint32_t inOrder(size_t i) const { return order_[i]; }
  glm::vec3 corner(uint32_t triangle, int i) const {
    return vertices_[indices_[size_t{3} * triangle + static_cast<size_t>(i)]].position;
  }
  /// Not normalised; points to the void side.
  glm::vec3 facing(uint32_t triangle) const;
  /// Bounds of the mesh; lo > hi where there is none.
  glm::vec3 lo() const { return nodes_[0].lo; }
  glm::vec3 hi() const { return nodes_[0].hi; }

 private:
  struct Node {
    glm::vec3 lo{1e30f}, hi{-1e30f};
  };

  void meet(uint32_t triangle, glm::vec3 from, glm::vec3 direction, std::optional<RayHit>& nearest, float& limit) const;

  std::span<const RenderVertex> vertices_;
  std::span<const uint32_t> indices_;
  std::pmr::vector<uint32_t> order_;
  std::pmr::vector<Node> nodes_;  ///< a heap: the children of i are 2i + 1 and 2i + 2; the last `leaves_` are leaves
  size_t leaves_ = 1;             ///< a power of two
};

}  // namespace sgm
