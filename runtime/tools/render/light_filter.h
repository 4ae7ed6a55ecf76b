#pragma once
// Removes noise from sparsely sampled light: smooths it along surfaces, where light changes slowly, but not across
// their edges.

#include <vector>

#include "tools/render/light_planes.h"

namespace sgm {

/// Geometry buffer for the filter: the visible surface at each element of a light plane, an image of DirectLight or
/// SoftLight values.
struct Guides {
  Guides(uint32_t w, uint32_t h) : width(w), height(h), positions(size_t{w} * h), normals(size_t{w} * h) {}

  void set(size_t at, glm::vec3 position, glm::vec3 normal, float distance) {
    positions[at] = glm::vec4(position, distance);
    normals[at] = normal;
  }

  uint32_t width, height;
  /// xyz: position in metres from the scene's origin; w: distance from the eye, negative if there is no surface
  std::vector<glm::vec4> positions;
  std::vector<glm::vec3> normals;
};

/// Smooths indirect light by an edge-avoiding filter that compares normals and planes (Dammertz et al., "Edge-avoiding
/// a-trous wavelet transform for fast global illumination filtering", 2010). element: angle in radians that one element
/// of `light` covers. May throw std::bad_alloc.
void filterSoft(std::vector<SoftLight>& light, const Guides& guides, float element, JobSystem& jobs);
/// Smooths the edges of shadows over two pixels, but leaves reflections unchanged. May throw std::bad_alloc.
void filterDirect(std::vector<DirectLight>& light, const Guides& guides, float element, JobSystem& jobs);

}  // namespace sgm
