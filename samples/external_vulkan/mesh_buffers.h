#pragma once
// The places of a chunk's triangles on the device: in buffers of the library, or in a buffer that the engine has filled
// itself.

#include <sgm/sgm.h>
#include <sgm/sgm_vulkan.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "../embed/handles.h"
#include "vulkan_device.h"
#include "vulkan_memory.h"

/// The draw of a part: the body, or the seam over a face. A null buffer means that the part has no triangles.
struct MeshPart {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDrawIndexedIndirectCommand command{};
};
using MeshParts = std::array<MeshPart, 1 + SGM_FACE_COUNT>;

inline sgm_mesh_view viewOf(const sgm_mesh* mesh) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_mesh_get_view(mesh, &view, &error), error);
  return view;
}

/// Meshes that the engine has uploaded into one buffer, in the library's format: vertices, then indices. An engine
/// needs this for meshes for which the library found no memory on the device.
class UploadedMeshes {
 public:
  UploadedMeshes(const VulkanDevice& device, std::span<const sgm_mesh_view> views) {
    size_t vertices = 0, indices = 0;
    for (const sgm_mesh_view& view : views) vertices += view.vertex_count, indices += view.index_count;
    parts_.resize(views.size());
    if (indices == 0) return;
    const size_t vertex_bytes = vertices * sizeof(sgm_vertex);
    buffer_ = HostBuffer(device, vertex_bytes + indices * sizeof(uint32_t),
                         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    size_t vertex = 0, index = vertex_bytes / sizeof(uint32_t);
    for (size_t i = 0; i < views.size(); ++i) {
      const sgm_mesh_view& view = views[i];
      copy<sgm_vertex>(view.vertices, view.vertex_count, view.vertex_stride, vertex);
      copy<uint32_t>(view.indices, view.index_count, view.index_stride, index);
      for (size_t p = 0; p < parts_[i].size(); ++p) {
        const sgm_mesh_range& range = p == 0 ? view.body : view.seams[p - 1];
        if (range.index_count == 0) continue;
        parts_[i][p] = {
            buffer_.get(),
            {range.index_count, 1, static_cast<uint32_t>(index) + range.first_index, static_cast<int32_t>(vertex), 0}};
      }
      vertex += view.vertex_count;
      index += view.index_count;
    }
  }

  const MeshParts& parts(size_t mesh) const { return parts_[mesh]; }

 private:
  /// Copies elements that lie `stride` bytes apart: in a later version of the library, elements may be larger than
  /// those of the header with which this program was built.
  template <class Element>
  void copy(const Element* elements, uint32_t count, uint32_t stride, size_t to) {
    const char* from = reinterpret_cast<const char*>(elements);
    std::byte* at = buffer_.data() + to * sizeof(Element);
    for (uint32_t i = 0; i < count; ++i, from += stride, at += sizeof(Element)) {
      std::memcpy(at, from, sizeof(Element));
    }
  }

  HostBuffer buffer_;
  std::vector<MeshParts> parts_;
};

/// A mesh that the engine may draw until it releases the mesh.
class StreamedMesh {
 public:
  StreamedMesh() = default;
  StreamedMesh(const VulkanDevice& device, MeshOwner mesh) : mesh_(std::move(mesh)) {
    view_ = viewOf(mesh_.get());
    sgm_vulkan_mesh_view place = SGM_VULKAN_MESH_VIEW_INIT;
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result found = sgm_mesh_get_vulkan_view(mesh_.get(), &place, &error);
    if (found == SGM_ERR_NOT_FOUND) {
      uploaded_.emplace(device, std::span(&view_, 1));
      parts_ = uploaded_->parts(0);
      return;
    }
    must(found, error);
    semaphore_ = place.semaphore;
    value_ = place.value;
    parts_[0] = {place.body.buffer, place.body.draw};
    for (size_t face = 0; face < SGM_FACE_COUNT; ++face) {
      parts_[1 + face] = {place.seams[face].buffer, place.seams[face].draw};
    }
  }

  explicit operator bool() const { return mesh_ != nullptr; }
  /// Whether the library has put the mesh into buffers on the device. False if the mesh has no triangles.
  bool resident() const { return semaphore_ != VK_NULL_HANDLE; }
  size_t bytes() const { return view_.vertex_count * sizeof(sgm_vertex) + view_.index_count * sizeof(uint32_t); }
  const MeshParts& parts() const { return parts_; }
  const sgm_mesh_view& view() const { return view_; }
  VkSemaphore semaphore() const { return semaphore_; }
  uint64_t value() const { return value_; }

 private:
  MeshOwner mesh_;
  sgm_mesh_view view_ = SGM_MESH_VIEW_INIT;
  std::optional<UploadedMeshes> uploaded_;
  MeshParts parts_{};
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
  uint64_t value_ = 0;
};
