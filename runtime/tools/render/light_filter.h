#pragma once
// Removes noise from sparsely sampled light. Light changes slowly along a surface, so it is smoothed there, but not
// across the surface's edges.

#include <vector>

#include "tools/render/light_planes.h"

namespace sgm {

/// The visible surface at each element of a plane of light.
struct Guides {
  Guides(uint32_t w, uint32_t h) : width(w), height(h), positions(size_t{w} * h), normals(size_t{w} * h) {}

  void set(size_t at, glm::vec3 position, glm::vec3 normal, float distance) {
    positions[at] = glm::vec4(position, distance);
    normals[at] = normal;
  }

  uint32_t width, height;
  /// xyz: metres from the scene's origin; w: distance from the eye, or below 0 if there is no surface
  std::vector<glm::vec4> positions;
  std::vector<glm::vec3> normals;
};

/// Smooths soft light by an edge-avoiding filter that compares normals and planes (Dammertz et al., "Edge-avoiding
/// a-trous wavelet transform for fast global illumination filtering", 2010). element: angle that one element covers, in
/// radians. May throw std::bad_alloc.
void filterSoft(std::vector<SoftLight>& light, const Guides& guides, float element, JobSystem& jobs);
/// Softens the edges of shadows over two pixels; reflections stay sharp. May throw std::bad_alloc.
void filterDirect(std::vector<DirectLight>& light, const Guides& guides, float element, JobSystem& jobs);

}  // namespace sgm
