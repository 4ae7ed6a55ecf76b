#include "tools/flight/flight_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "mesh/vertex.h"

namespace sgm::cli {
namespace {

constexpr int kMargin = 8;                                 // space between the pictures of a sheet, pixels
constexpr std::array<uint8_t, 4> kSheet{24, 24, 26, 255};  // RGBA colour between the pictures of a sheet

/// Colours of the levels of detail, from fine to coarse; used cyclically if there are more levels.
constexpr std::array<glm::vec3, 8> kLevelColours{{{0.75f, 0.75f, 0.72f},
                                                  {0.18f, 0.55f, 0.22f},
                                                  {0.14f, 0.38f, 0.75f},
                                                  {0.80f, 0.55f, 0.10f},
                                                  {0.70f, 0.15f, 0.12f},
                                                  {0.50f, 0.20f, 0.65f},
                                                  {0.10f, 0.60f, 0.60f},
                                                  {0.55f, 0.30f, 0.15f}}};

std::vector<RenderMaterial> picturedMaterials(const sgm_grammar* grammar, bool levels) {
  std::vector<RenderMaterial> materials;
  for (const glm::vec3& colour : kLevelColours)
    if (levels) materials.push_back({SurfacePattern::plain, colour, 0.9f, 0.0f});
  for (uint32_t i = 0; !levels && i < sgm_grammar_material_count(grammar); ++i)
    materials.push_back(materialByName(sgm_grammar_material(grammar, i)));
  if (materials.empty()) materials.emplace_back();
  return materials;
}

template <class T>
T packedAt(const T* first, uint32_t stride, size_t i) {
  T element;
  std::memcpy(&element, reinterpret_cast<const char*>(first) + stride * i, sizeof element);
  return element;
}

struct PictureMesh {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;

  void add(const sgm_mesh_view& mesh, const sgm_mesh_range& range, Int3 origin, bool levels) {
    const auto first = static_cast<uint32_t>(vertices.size());
    const double unit = static_cast<double>(mesh.cell_units) / kSubcell;
    for (uint32_t i = 0; i < range.vertex_count; ++i) {
      const sgm_vertex v = packedAt(mesh.vertices, mesh.vertex_stride, range.first_vertex + i);
      const std::array<int16_t, 3> local{v.x, v.y, v.z};
      const std::array<double, 3> normal = unpackNormal(v.normal_x, v.normal_y);
      RenderVertex vertex;
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<size_t>(axis);
        const double units = static_cast<double>(int64_t{mesh.origin[axis]} - origin[axis]) + unit * local[at];
        vertex.position[axis] = static_cast<float>(units / kUnitsPerMetre);
        vertex.normal[axis] = static_cast<float>(normal[at]);
      }
      vertex.material = levels ? static_cast<uint32_t>(mesh.key.level) % kLevelColours.size() : v.material;
      vertices.push_back(vertex);
    }
    for (uint32_t i = 0; i < range.index_count; ++i)
      indices.push_back(packedAt(mesh.indices, mesh.index_stride, range.first_index + i) - range.first_vertex + first);
  }
};

}  // namespace

Result<Image> drawChunks(const Renderer& renderer, const sgm_grammar* grammar, std::span<const PicturedChunk> chunks,
                         const PictureRequest& request) {
  RenderScene scene;
  // Place the scene's origin near the camera, so that single precision suffices anywhere in the world.
  for (int axis = 0; axis < 3; ++axis)
    scene.origin[axis] = saturate(std::llround(request.camera.position[axis]) * kUnitsPerMetre);
  PictureMesh mesh;
  for (const PicturedChunk& chunk : chunks) {
    mesh.add(chunk.mesh, chunk.mesh.body, scene.origin, request.levels);
    for (uint32_t face = 0; face < SGM_FACE_COUNT; ++face)
      if ((chunk.seams >> face & 1) != 0) mesh.add(chunk.mesh, chunk.mesh.seams[face], scene.origin, request.levels);
  }
  RenderCamera camera;
  for (int axis = 0; axis < 3; ++axis)
    camera.position[axis] = static_cast<float>(request.camera.position[axis] - metres(scene.origin[axis]));
  camera.target = camera.position + glm::vec3(request.camera.direction);
  camera.fov_degrees = static_cast<float>(request.fov_degrees);
  camera.width = request.width;
  camera.height = request.height;
  const std::vector<RenderMaterial> materials = picturedMaterials(grammar, request.levels);
  scene.vertices = mesh.vertices;
  scene.indices = mesh.indices;
  scene.materials = materials;
  View view;
  view.camera = camera;
  view.depth = static_cast<float>(request.depth);
  lightScene(view, request.levels ? Light::lamp : request.light, scene);
  if (request.levels) {
    // Use even light and no haze, so that the colours of far levels are visible.
    scene.ambient = 0.2f;
    scene.exposure = 1.6f;
    scene.fog_distance = 1e6f;
  }
  return renderer.render(scene);
}

Image contactSheet(std::span<const Image> images, int columns) {
  Image sheet;
  if (images.empty()) return sheet;
  int width = 0, height = 0;
  for (const Image& image : images) {
    width = std::max(width, image.width);
    height = std::max(height, image.height);
  }
  const int count = static_cast<int>(images.size());
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  sheet.width = columns * (width + kMargin) + kMargin;
  sheet.height = rows * (height + kMargin) + kMargin;
  sheet.rgba.resize(size_t{4} * static_cast<size_t>(sheet.width) * static_cast<size_t>(sheet.height));
  for (size_t i = 0; i < sheet.rgba.size(); ++i) sheet.rgba[i] = kSheet[i % 4];
  const auto offset = [](const Image& image, int x, int y) {
    return 4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
  };
  for (int i = 0; i < count; ++i) {
    const Image& image = images[static_cast<size_t>(i)];
    const int left = kMargin + i % columns * (width + kMargin), top = kMargin + i / columns * (height + kMargin);
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.rgba.data() + offset(image, 0, y), size_t{4} * static_cast<size_t>(image.width),
                  sheet.rgba.data() + offset(sheet, left, top + y));
  }
  return sheet;
}

}  // namespace sgm::cli
