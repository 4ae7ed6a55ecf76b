#include "asset/read/glb_reader.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "asset/read/glb_accessor.h"
#include "asset/read/glb_container.h"
#include "asset/read/glb_material.h"
#include "asset/read/glb_primitive.h"
#include "asset/read/glb_scene.h"
#include "asset/read/mesh_notes.h"
#include "asset/read/text_reader.h"
#include "asset/read/word_list.h"
#include "base/json_reader.h"

namespace sgm::asset {

namespace {

/// glTF extensions that this reader implements.
constexpr std::string_view kDone[] = {"KHR_mesh_quantization", "KHR_node_visibility", "EXT_mesh_gpu_instancing"};
/// Name prefixes of glTF extensions that can be ignored, because they do not change the triangles.
constexpr std::string_view kHarmless[] = {"KHR_materials_",
                                          "KHR_texture_",
                                          "KHR_lights_",
                                          "KHR_xmp",
                                          "KHR_animation_",
                                          "KHR_audio",
                                          "KHR_node_hoverability",
                                          "KHR_node_selectability",
                                          "KHR_interactivity",
                                          "KHR_physics_",
                                          "KHR_implicit_shapes",
                                          "KHR_collision_shapes",
                                          "KHR_techniques_webgl",
                                          "EXT_texture_",
                                          "EXT_lights_",
                                          "EXT_mesh_features",
                                          "EXT_structural_metadata",
                                          "EXT_instance_features",
                                          "EXT_mesh_manifold",
                                          "EXT_primitive_restart_hint",
                                          "MSFT_texture_dds",
                                          "MSFT_packing_",
                                          "MSFT_audio",
                                          "MSFT_physics",
                                          "ADOBE_materials_",
                                          "AGI_",
                                          "CESIUM_primitive_outline",
                                          "EXT_environment",
                                          "VRM",
                                          "VRMC_",
                                          "GODOT_",
                                          "OMI_",
                                          "MOZ_",
                                          "FB_",
                                          "NV_materials_",
                                          "NVIDIA_",
                                          "WEB3D_"};
/// glTF extensions that compress data. If a file does not require such an extension, it also contains the data
/// uncompressed.
constexpr std::string_view kPacking[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                         "KHR_meshopt_compression"};

bool isHarmless(std::string_view extension) {
  return std::any_of(std::begin(kHarmless), std::end(kHarmless),
                     [&](std::string_view start) { return extension.starts_with(start); });
}

/// Adds notes about ignored extensions. Error: bad_input if the file requires an unsupported extension.
Result<void> checkExtensions(const JsonValue& root, std::vector<std::string>& notes) {
  const auto required = root.list("extensionsRequired");
  for (const JsonValue& extension : required)
    if (!isIn(kDone, extension.text) && !isHarmless(extension.text))
      return wrongInJson("it needs the extension " + shown(extension.text), "/extensionsRequired");
  NotedPlaces unknown;
  for (const JsonValue& extension : root.list("extensionsUsed"))
    if (!isIn(kDone, extension.text) && !isHarmless(extension.text) && !isIn(kPacking, extension.text))
      unknown.add([&] { return shown(extension.text); });
  if (unknown.count > 0)
    notes.push_back(counted(unknown.count, "extension that it uses is left out, ",
                            "extensions that it uses are left out, the first ") +
                    unknown.first);
  return {};
}

bool uses(const JsonValue& root, std::string_view extension) {
  for (const char* const list : {"extensionsUsed", "extensionsRequired"})
    for (const JsonValue& used : root.list(list))
      if (used.text == extension) return true;
  return false;
}

}  // namespace

Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits) {
  Result<GlbContainer> file = openGlb(bytes);
  if (!file) return file.error();
  // The size of the JSON is limited only in binary files: glTF as text may store the geometry itself in the JSON, as a
  // few long strings.
  if (!file->is_text && file->json.size() > limits.json_bytes) return overLimit(limits.json_bytes, "bytes of JSON");
  const Result<JsonValue> root = readJson(file->json, limits.json_bytes / 2 + 1);
  if (!root) return root.error();
  std::vector<std::string> notes = std::move(file->notes);
  if (Result<void> fine = checkExtensions(*root, notes); !fine) return fine.error();
  Result<std::vector<GlbMaterial>> materials = readGlbMaterials(*root);
  if (!materials) return materials.error();
  const GlbAccessors accessors(*root, *file, uses(*root, "KHR_mesh_quantization"));
  GlbMeshes meshes(*root, accessors, std::move(*materials), limits);
  meshes.mesh().notes = std::move(notes);
  if (Result<void> shown = GlbScene(*root, accessors, meshes, limits).show(); !shown) return shown.error();
  return meshes.finish();
}

}  // namespace sgm::asset
