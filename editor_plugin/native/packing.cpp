#include "packing.h"

#include <algorithm>
#include <cmath>

namespace sgm_godot {
namespace {

// Flags of the engine's enum Mesh.ArrayFormat.
constexpr uint64_t kVertex = 1, kNormal = 2, kUv = 16, kCustom0 = 64, kIndex = 4096;
constexpr uint64_t kRgbaFloat = 7;
constexpr int kCustomShift = 13, kVersionShift = 35;
constexpr uint64_t kFormat =
    kVertex | kNormal | kUv | kCustom0 | kIndex | kRgbaFloat << kCustomShift | uint64_t{1} << kVersionShift;
constexpr int64_t kTriangles = 3;

/// The attributes of a vertex other than position and normal, in the order of the engine's vertex format.
struct Attributes {
  float uv[2];
  float words[4];  // whole numbers below 2^24, which surface.gdshaderinc unpacks
};
static_assert(sizeof(Attributes) == 24);

constexpr uint32_t kNone = UINT32_MAX;

// Morphing moves a vertex by up to four grid cells on an axis, in steps of 1/256 cell.
constexpr int kMaxMorph = 1024, kMorphBits = 12;
constexpr uint32_t kMorphZero = 2048;

/// The triangles of one material slot, as indices of corners. A corner is a wedge of the mesh (a vertex with texture
/// coordinates, see sgm.h), or a vertex if the mesh has no wedges.
struct Corners {
  std::vector<uint32_t> indices;  // three for each triangle: indices of its corners in `used`
  std::vector<uint32_t> used;     // the distinct corners of these triangles, as indices of the mesh's corners
};

struct Reader {
  const sgm_mesh_view& mesh;
  bool wedges = mesh.wedges != nullptr && mesh.wedge_indices != nullptr;

  uint32_t count() const { return wedges ? mesh.wedge_count : mesh.vertex_count; }
  uint32_t corner(uint32_t index) const { return wedges ? mesh.wedge_indices[index] : mesh.indices[index]; }
  const sgm_wedge& wedge(uint32_t corner) const {
    return *reinterpret_cast<const sgm_wedge*>(reinterpret_cast<const char*>(mesh.wedges) +
                                               size_t{corner} * mesh.wedge_stride);
  }
  uint32_t vertexOf(uint32_t corner) const { return wedges ? wedge(corner).vertex : corner; }
  const sgm_vertex& vertex(uint32_t corner) const {
    return *reinterpret_cast<const sgm_vertex*>(reinterpret_cast<const char*>(mesh.vertices) +
                                                size_t{vertexOf(corner)} * mesh.vertex_stride);
  }
  uint16_t dominant(const uint32_t corners[3]) const {
    if (!wedges) return vertex(corners[0]).material;
    int shares = 0;
    for (int i = 0; i < 3; ++i) shares += wedge(corners[i]).share;
    return wedge(corners[0]).materials[shares * 2 > 3 * 255 ? 1 : 0];
  }
  float scale() const { return static_cast<float>(mesh.cell_units) / (SGM_SUBCELL * float{SGM_UNITS_PER_METRE}); }
  Vector3 position(uint32_t corner) const {
    const sgm_vertex& v = vertex(corner);
    return Vector3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)} * scale();
  }
};

std::vector<Corners> collect(const Reader& reader, Part part, const std::vector<uint16_t>& slots) {
  const uint16_t last = slots.empty() ? uint16_t{0} : *std::max_element(slots.begin(), slots.end());
  std::vector<Corners> result(size_t{last} + 1);
  std::vector<std::vector<uint32_t>> places(result.size());
  const auto add = [&](const sgm_mesh_range& range) {
    for (uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
      const uint32_t corners[3] = {reader.corner(i), reader.corner(i + 1), reader.corner(i + 2)};
      const uint16_t material = reader.dominant(corners);
      const size_t slot = material < slots.size() ? slots[material] : 0;
      std::vector<uint32_t>& place = places[slot];
      if (place.empty()) place.assign(reader.count(), kNone);
      // The engine's front faces are clockwise, the mesh's are not: the second and third corner are swapped.
      for (const int order : {0, 2, 1}) {
        uint32_t& at = place[corners[order]];
        if (at == kNone) {
          at = static_cast<uint32_t>(result[slot].used.size());
          result[slot].used.push_back(corners[order]);
        }
        result[slot].indices.push_back(at);
      }
    }
  };
  if (part.body) add(reader.mesh.body);
  for (uint32_t face = 0; face < SGM_FACE_COUNT; ++face) {
    if (part.seams & (1u << face)) add(reader.mesh.seams[face]);
  }
  return result;
}

/// Stores three bytes exactly in a float. With OpenGL, the engine (4.6) reduces the precision of byte and half-float
/// channels, but not of floats.
float word(uint32_t low, uint32_t middle, uint32_t high) { return static_cast<float>(low | middle << 8 | high << 16); }

uint16_t unsignedNormal(int16_t coordinate) {
  return static_cast<uint16_t>(((coordinate + 32767) * 65535 + 32767) / 65534);
}

Vector3 normalOf(const sgm_vertex& v) {
  Vector3 n{static_cast<float>(v.normal_x) / 32767, static_cast<float>(v.normal_y) / 32767, 0};
  n.z = 1 - std::abs(n.x) - std::abs(n.y);
  if (n.z < 0) {
    const float x = n.x;
    n.x = (1 - std::abs(n.y)) * (x >= 0 ? 1.0f : -1.0f);
    n.y = (1 - std::abs(x)) * (n.y >= 0 ? 1.0f : -1.0f);
  }
  const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  return length > 0 ? n * (1 / length) : Vector3{0, 1, 0};
}

Attributes attributesOf(const Reader& reader, uint32_t corner) {
  Attributes a{};
  const auto byte = [](uint16_t material) { return std::min<uint32_t>(material, 255); };
  if (reader.wedges) {
    const sgm_wedge& w = reader.wedge(corner);
    a.uv[0] = w.u;
    a.uv[1] = w.v;
    a.words[2] = word(byte(w.materials[0]), byte(w.materials[1]), w.share);
    a.words[3] = word(w.plane_shares[0], w.plane_shares[1], w.plane_shares[2]);
  } else {
    const uint32_t material = byte(reader.vertex(corner).material);
    a.words[2] = word(material, material, 0);
  }
  uint32_t morph[3] = {kMorphZero, kMorphZero, kMorphZero};
  if (reader.mesh.morphs != nullptr) {
    const int16_t* offset = reader.mesh.morphs + size_t{reader.vertexOf(corner)} * 3;
    for (int i = 0; i < 3; ++i) {
      morph[i] = static_cast<uint32_t>(std::clamp<int>(offset[i], -kMaxMorph, kMaxMorph) + int{kMorphZero});
    }
  }
  a.words[0] = static_cast<float>(morph[0] | morph[1] << kMorphBits);
  a.words[1] = static_cast<float>(morph[2] | static_cast<uint32_t>(reader.mesh.key.level) << kMorphBits);
  return a;
}

Variant surfaceOf(const Reader& reader, const Corners& corners) {
  const size_t count = corners.used.size();
  constexpr size_t kPosition = sizeof(Vector3), kPackedNormal = 2 * sizeof(uint16_t);
  Packed<uint8_t> vertices(count * (kPosition + kPackedNormal)), attributes(count * sizeof(Attributes));
  Vector3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < count; ++i) {
    const uint32_t corner = corners.used[i];
    const Vector3 p = reader.position(corner);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    std::memcpy(vertices.data() + i * kPosition, &p, kPosition);
    const sgm_vertex& v = reader.vertex(corner);
    const uint16_t normal[2] = {unsignedNormal(v.normal_x), unsignedNormal(v.normal_y)};
    std::memcpy(vertices.data() + count * kPosition + i * kPackedNormal, normal, kPackedNormal);
    const Attributes a = attributesOf(reader, corner);
    std::memcpy(attributes.data() + i * sizeof a, &a, sizeof a);
  }
  const bool narrow = count <= 65536;  // for up to 65536 vertices, the engine expects 16-bit indices
  Packed<uint8_t> indices(corners.indices.size() * (narrow ? 2 : 4));
  for (size_t i = 0; i < corners.indices.size(); ++i) {
    if (narrow) {
      const auto index = static_cast<uint16_t>(corners.indices[i]);
      std::memcpy(indices.data() + i * 2, &index, 2);
    } else {
      std::memcpy(indices.data() + i * 4, &corners.indices[i], 4);
    }
  }
  const float room = reader.mesh.morphs != nullptr ? reader.scale() * kMaxMorph : 0;
  const Vector3 grow{room, room, room};
  Variant surface = Variant::dictionary();
  surface.set("primitive", kTriangles);
  surface.set("format", kFormat);
  surface.set("vertex_data", vertices.take());
  surface.set("vertex_count", static_cast<int64_t>(count));
  surface.set("attribute_data", attributes.take());
  surface.set("index_data", indices.take());
  surface.set("index_count", static_cast<int64_t>(corners.indices.size()));
  surface.set("aabb", Aabb{low - grow, high - low + grow + grow});
  return surface;
}

}  // namespace

std::vector<PackedSurface> packSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots) {
  const Reader reader{mesh};
  const std::vector<Corners> by_slot = collect(reader, part, slots);
  std::vector<PackedSurface> result;
  for (size_t slot = 0; slot < by_slot.size(); ++slot) {
    const Corners& corners = by_slot[slot];
    if (corners.indices.empty()) continue;
    result.push_back(
        {surfaceOf(reader, corners), static_cast<uint16_t>(slot), static_cast<uint32_t>(corners.indices.size() / 3)});
  }
  return result;
}

std::vector<PlainSurface> plainSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots,
                                        const std::vector<Color>& palette) {
  const Reader reader{mesh};
  const std::vector<Corners> by_slot = collect(reader, part, slots);
  const auto colorOf = [&](uint16_t material) { return material < palette.size() ? palette[material] : Color{}; };
  std::vector<PlainSurface> result;
  for (size_t slot = 0; slot < by_slot.size(); ++slot) {
    const Corners& corners = by_slot[slot];
    if (corners.indices.empty()) continue;
    PlainSurface& s = result.emplace_back();
    s.slot = static_cast<uint16_t>(slot);
    s.indices.assign(corners.indices.begin(), corners.indices.end());
    for (const uint32_t corner : corners.used) {
      s.positions.push_back(reader.position(corner));
      s.normals.push_back(normalOf(reader.vertex(corner)));
      if (!reader.wedges) {
        s.coordinates.push_back({});
        s.colors.push_back(colorOf(reader.vertex(corner).material));
        continue;
      }
      const sgm_wedge& w = reader.wedge(corner);
      s.coordinates.push_back({w.u, w.v});
      const Color a = colorOf(w.materials[0]), b = colorOf(w.materials[1]);
      const float t = static_cast<float>(w.share) / 255;
      s.colors.push_back({a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, 1});
    }
  }
  return result;
}

std::vector<Variant> packFaces(const sgm_collider_view& collider, size_t most) {
  std::vector<Variant> result;
  const size_t triangles = collider.index_count / 3;
  for (size_t first = 0; first < triangles; first += most) {
    const size_t count = std::min(most, triangles - first);
    Packed<Vector3> faces(count * 3);
    for (size_t i = 0; i < count * 3; ++i) {
      // The engine's front faces are clockwise: swap the second and third corner.
      const size_t corner = i % 3 == 0 ? i : i % 3 == 1 ? i + 1 : i - 1;
      std::memcpy(static_cast<void*>(faces.data() + i),
                  collider.positions + size_t{collider.indices[first * 3 + corner]} * 3, sizeof(Vector3));
    }
    result.push_back(faces.take());
  }
  return result;
}

}  // namespace sgm_godot
