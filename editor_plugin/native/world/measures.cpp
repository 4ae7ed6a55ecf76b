#include "world/measures.h"

#include <cmath>

#include "godot/log.h"

namespace sgm_godot {
namespace {

struct Drawn {
  std::vector<sgm_drawn_chunk> chunks;
  std::vector<MeshOwner> owners;
};

Drawn drawnOf(const Session& session) {
  Drawn drawn{session.drawn(), {}};
  for (const sgm_drawn_chunk& chunk : drawn.chunks) drawn.owners.emplace_back(chunk.mesh);
  return drawn;
}

uint64_t defectsOf(const sgm_chunk_sums& sums) {
  uint64_t total = 0;
  for (const uint64_t count : sums.defects) total += count;
  return total;
}

/// The triangles of all drawn chunks. Positions are exact, relative to the first chunk's corner.
struct Soup {
  std::vector<double> positions;  // metres
  std::vector<uint32_t> indices;
};

void addTriangles(const sgm_mesh_view& view, uint32_t seams, const int32_t base[3], Soup& soup) {
  const auto first = static_cast<uint32_t>(soup.positions.size() / 3);
  for (uint32_t i = 0; i < view.vertex_count; ++i) {
    const auto& v = *reinterpret_cast<const sgm_vertex*>(reinterpret_cast<const char*>(view.vertices) +
                                                         size_t{i} * view.vertex_stride);
    const int16_t at[3] = {v.x, v.y, v.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      const double corner = static_cast<double>(int64_t{view.origin[axis]} - base[axis]);
      const double units = corner + static_cast<double>(int64_t{at[axis]} * view.cell_units) / SGM_SUBCELL;
      soup.positions.push_back(units / SGM_UNITS_PER_METRE);
    }
  }
  const auto add = [&](const sgm_mesh_range& range) {
    for (uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
      uint32_t corner[3];
      for (uint32_t c = 0; c < 3; ++c) corner[c] = first + view.indices[i + c];
      const auto same = [&](uint32_t a, uint32_t b) {
        return std::equal(&soup.positions[size_t{a} * 3], &soup.positions[size_t{a} * 3] + 3,
                          &soup.positions[size_t{b} * 3]);
      };
      // Skip degenerate triangles without area, which seams may contain.
      if (same(corner[0], corner[1]) || same(corner[1], corner[2]) || same(corner[0], corner[2])) continue;
      soup.indices.insert(soup.indices.end(), corner, corner + 3);
    }
  };
  add(view.body);
  for (uint32_t face = 0; face < SGM_FACE_COUNT; ++face) {
    if (seams & (1u << face)) add(view.seams[face]);
  }
}

template <class T>
Variant packed(const std::vector<T>& values) {
  Packed<T> array(values.size());
  if (!values.empty()) std::memcpy(static_cast<void*>(array.data()), values.data(), values.size() * sizeof(T));
  return array.take();
}

// Values of the engine's enum Mesh.ArrayType.
constexpr int64_t kVertex = 0, kNormal = 1, kColor = 3, kUv = 4, kIndex = 12, kArrays = 13;

}  // namespace

Dictionary drawnMeasures(const World& world) {
  const std::shared_ptr<Session>& session = world.stage().session();
  Dictionary result;
  sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
  if (session == nullptr || sgm_world_get_measures(session->world(), &measures, nullptr) != SGM_OK) return result;
  const sgm_chunk_sums& drawn = measures.drawn;
  const uint64_t defects = defectsOf(drawn);
  result.value.set("area", drawn.area);
  result.value.set("volume", std::abs(drawn.flux));
  result.value.set("triangles", drawn.triangles);
  result.value.set("slivers", drawn.sliver_triangles);
  result.value.set("defects", defects);
  result.value.set("watertight", defects == 0);
  result.value.set("chunks", drawn.bodies);
  return result;
}

Dictionary measureDrawn(const World& world, int64_t bins) {
  Dictionary result;
  const std::shared_ptr<Session> session = world.stage().active().placed().session;
  if (session == nullptr) return result;
  const Drawn drawn = drawnOf(*session);
  Soup soup;
  for (const sgm_drawn_chunk& chunk : drawn.chunks) {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (sgm_mesh_get_view(chunk.mesh, &view, nullptr) != SGM_OK || view.index_count == 0) continue;
    sgm_mesh_view first = SGM_MESH_VIEW_INIT;
    sgm_mesh_get_view(drawn.chunks.front().mesh, &first, nullptr);
    addTriangles(view, chunk.seams, first.origin, soup);
  }
  std::vector<double> histogram(static_cast<size_t>(std::clamp<int64_t>(bins, 1, 4096)));
  sgm_measure_desc desc = SGM_MEASURE_DESC_INIT;
  desc.positions_double = soup.positions.data();
  desc.position_count = soup.positions.size() / 3;
  desc.indices = soup.indices.data();
  desc.index_count = soup.indices.size();
  desc.flags = SGM_MEASURE_NO_SELF_INTERSECTIONS;
  desc.histogram_bins = static_cast<uint32_t>(histogram.size());
  desc.histogram_capacity = desc.histogram_bins;
  desc.histogram = histogram.data();
  sgm_measures measures = SGM_MEASURES_INIT;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_measure(world.node().plugin.runtime, &desc, &measures, &error) < SGM_OK) {
    logError(std::string("SgmWorld3D: ") + error.message);
    return result;
  }
  result.value.set("area", measures.area);
  result.value.set("volume", std::abs(measures.volume));
  result.value.set("triangles", measures.triangles);
  result.value.set("objects", measures.objects);
  result.value.set("shells", measures.shells);
  result.value.set("histogram", packed(histogram));
  result.value.set("flat", measures.flat);
  result.value.set("convex", measures.convex);
  result.value.set("concave", measures.concave);
  return result;
}

Array bakeChunks(const World& world) {
  Array list;
  const std::shared_ptr<Session>& session = world.stage().session();
  const Materials& materials = world.stage().pictures().materials();
  if (session == nullptr) return list;
  const Drawn drawn = drawnOf(*session);
  const Placement here = world.node().placement();
  for (const sgm_drawn_chunk& chunk : drawn.chunks) {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (sgm_mesh_get_view(chunk.mesh, &view, nullptr) != SGM_OK || view.index_count == 0) continue;
    const Variant surfaces = Variant::array();
    std::vector<Vector3> faces;
    for (const PlainSurface& plain : plainSurfaces(view, {true, chunk.seams}, materials.slots(), materials.palette())) {
      Variant arrays = Variant::array();
      arrays.call("resize", kArrays);
      arrays.set(kVertex, packed(plain.positions));
      arrays.set(kNormal, packed(plain.normals));
      arrays.set(kColor, packed(plain.colors));
      arrays.set(kUv, packed(plain.coordinates));
      arrays.set(kIndex, packed(plain.indices));
      Variant surface = Variant::dictionary();
      surface.set("material", materials.name(plain.slot));
      surface.set("arrays", arrays);
      surfaces.append(surface);
      for (const int32_t index : plain.indices) faces.push_back(plain.positions[static_cast<size_t>(index)]);
    }
    if (faces.empty()) continue;
    Variant entry = Variant::dictionary();
    entry.set("name", "chunk_" + std::to_string(view.key.level) + "_" + std::to_string(view.key.x) + "_" +
                          std::to_string(view.key.y) + "_" + std::to_string(view.key.z));
    entry.set("transform", here.ofCorner(view.origin));
    entry.set("surfaces", surfaces);
    entry.set("faces", packed(faces));
    list.value.append(entry);
  }
  return list;
}

}  // namespace sgm_godot
