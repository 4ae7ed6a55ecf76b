#pragma once
// Removes noise from sparsely sampled light, which changes slowly along a surface but not across its edges.

#include <vector>

#include "tools/render/light_planes.h"

namespace sgm {

/// The surface at each element of a plane.
struct Guides {
  Guides(uint32_t w, uint32_t h) : width(w), height(h), positions(size_t{w} * h), normals(size_t{w} * h) {}

  void set(size_t at, glm::vec3 position, glm::vec3 normal, float distance) {
    positions[at] = glm::vec4(position, distance);
    normals[at] = normal;
  }

  uint32_t width, height;
  std::vector<glm::vec4> positions;  ///< w: distance from the eye, below 0: no surface
  std::vector<glm::vec3> normals;
};

/// An edge-avoiding filter by normals and planes (Dammertz et al., "Edge-avoiding a-trous wavelet transform for fast
/// global illumination filtering", 2010). element: angle of one element in radians. May throw std::bad_alloc.
void filterSoft(std::vector<SoftLight>& light, const Guides& guides, float element, JobSystem& jobs);
/// Softens the edges of shadows over two pixels; mirrors stay sharp. May throw std::bad_alloc.
void filterDirect(std::vector<DirectLight>& light, const Guides& guides, float element, JobSystem& jobs);

}  // namespace sgm
