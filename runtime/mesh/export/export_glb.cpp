// Binary glTF 2.0. The specification: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#include <algorithm>
#include <limits>
#include <map>

#include "base/utf8.h"
#include "mesh/export/export_formats.h"

namespace sgm {
namespace {

constexpr uint32_t kNoVertex = std::numeric_limits<uint32_t>::max();
constexpr size_t kVertexBytes = 28;   // bytes per vertex: position, normal, tag, two bytes of padding
constexpr size_t kTextureBytes = 12;  // additional bytes per vertex with a texture: coordinates, blend
constexpr size_t kColourBytes = 8;    // additional bytes per vertex of a primitive with two materials: colour

/// The triangles of one material, or of a pair of materials. The primitive's own vertices are in the order in which its
/// triangles first use them.
struct Primitive {
  std::array<uint16_t, 2> materials{};
  size_t vertex_size = kVertexBytes;
  std::vector<uint32_t> vertices;  // indices of the mesh's vertices; with a texture, indices of its texture vertices
  std::vector<uint32_t> indices;   // indices into `vertices`
  Float3 low{}, high{};

  bool blends() const { return materials[0] != materials[1]; }
  // True if 16-bit indices suffice. Index 65535 is not available, because it means primitive restart.
  bool shortIndices() const { return vertices.size() <= 65535; }
  size_t indexBytes() const { return indices.size() * (shortIndices() ? 2 : 4); }
  size_t paddedIndexBytes() const { return (indexBytes() + 3) / 4 * 4; }
  size_t vertexBytes() const { return vertices.size() * vertex_size; }
};

uint32_t vertexOf(const ExportTexture* texture, uint32_t number) {
  return texture != nullptr ? texture->vertices[number] : number;
}

std::vector<Primitive> splitByMaterial(const WorldMesh& mesh, const ExportTexture* texture) {
  // for each pair of materials: the positions in mesh.indices at which its triangles start
  std::map<std::array<uint16_t, 2>, std::vector<size_t>> triangles_of;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint16_t alone = triangleMaterial(mesh, i);
    const bool blended = texture != nullptr;
    triangles_of[blended ? texture->blends[texture->corners[i]].materials : std::array{alone, alone}].push_back(i);
  }
  std::vector<Primitive> primitives;
  std::vector<uint32_t> renumbered(texture != nullptr ? texture->vertices.size() : mesh.positions.size(), kNoVertex);
  for (const auto& [materials, triangles] : triangles_of) {
    Primitive& primitive = primitives.emplace_back();
    primitive.materials = materials;
    if (texture != nullptr) primitive.vertex_size += kTextureBytes;
    if (primitive.blends()) primitive.vertex_size += kColourBytes;
    primitive.indices.reserve(triangles.size() * 3);
    for (const size_t i : triangles) {
      for (size_t corner = 0; corner < 3; ++corner) {
        const uint32_t vertex = texture != nullptr ? texture->corners[i + corner] : mesh.indices[i + corner];
        if (renumbered[vertex] == kNoVertex) {
          renumbered[vertex] = static_cast<uint32_t>(primitive.vertices.size());
          primitive.vertices.push_back(vertex);
        }
        primitive.indices.push_back(renumbered[vertex]);
      }
    }
    primitive.low = primitive.high = exportedPosition(mesh, vertexOf(texture, primitive.vertices.front()));
    for (uint32_t vertex : primitive.vertices) {
      renumbered[vertex] = kNoVertex;
      const Float3 position = exportedPosition(mesh, vertexOf(texture, vertex));
      for (size_t axis = 0; axis < 3; ++axis) {
        primitive.low[axis] = std::min(primitive.low[axis], position[axis]);
        primitive.high[axis] = std::max(primitive.high[axis], position[axis]);
      }
    }
  }
  return primitives;
}

/// Returns a JSON string. Bytes that are not UTF-8 would make the file invalid: they become '?'.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (size_t i = 0; i < text.size();) {
    const size_t length = utf8Size(std::string_view(text).substr(i));
    const auto lead = static_cast<unsigned char>(text[i]);
    if (length == 0) {
      out += '?';
      ++i;
      continue;
    }
    if (lead == '"' || lead == '\\') out += '\\';
    if (lead < 0x20) {
      constexpr char kHex[] = "0123456789abcdef";
      out += "\\u00";
      out += kHex[lead >> 4];
      out += kHex[lead & 15];
    } else {
      out.append(text, i, length);
    }
    i += length;
  }
  return out + '"';
}

std::string vectorText(const Float3& v) {
  return '[' + decimalText(v[0]) + ',' + decimalText(v[1]) + ',' + decimalText(v[2]) + ']';
}

/// Returns a JSON array of the texts item(i) for i < count.
template <class Item>
std::string listOf(size_t count, Item item) {
  std::string out = "[";
  for (size_t i = 0; i < count; ++i) {
    if (i > 0) out += ',';
    out += item(i);
  }
  return out + ']';
}

std::string extrasText(const WorldMesh& mesh, const ExportInfo& info) {
  const auto metres = [&](int axis) { return decimalText(mesh.origin[axis] / static_cast<double>(kUnitsPerMetre)); };
  return "{\"sgm\":{\"originUnits\":[" + std::to_string(mesh.origin.x) + ',' + std::to_string(mesh.origin.y) + ',' +
         std::to_string(mesh.origin.z) + "],\"unitsPerMetre\":" + std::to_string(kUnitsPerMetre) +
         ",\"originMetres\":[" + metres(0) + ',' + metres(1) + ',' + metres(2) +
         "],\"tags\":" + listOf(info.tags.size(), [&](size_t i) { return quoted(info.tags[i]); }) + "}}";
}

/// Returns the material of a primitive as JSON. If the primitive blends two materials, its base colour is white,
/// because the colours are in the vertices.
std::string materialText(const ExportInfo& info, const Primitive& primitive) {
  const ExportMaterial first = materialAt(info, primitive.materials[0]);
  const ExportMaterial second = materialAt(info, primitive.materials[1]);
  const auto channel = [&](size_t i) {
    return primitive.blends() ? std::string("1") : decimalText(std::clamp(first.colour[i], 0.0f, 1.0f));
  };
  const bool pictured = info.texture != nullptr && !info.texture->png.empty();
  const float roughness = (std::clamp(first.roughness, 0.0f, 1.0f) + std::clamp(second.roughness, 0.0f, 1.0f)) / 2;
  // Custom data ("extras") that names both materials: an importer may then blend materials of its own instead of the
  // vertices' colours.
  const std::string extras = !primitive.blends() ? ""
                                                 : ",\"extras\":{\"sgm\":{\"materials\":[" + quoted(first.name) + ',' +
                                                       quoted(second.name) + "],\"shareOfSecond\":\"_BLEND.w\"}}";
  return "{\"name\":" + quoted(primitive.blends() ? first.name + " + " + second.name : first.name) +
         ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[" + channel(0) + ',' + channel(1) + ',' + channel(2) +
         ",1]," + (pictured ? "\"baseColorTexture\":{\"index\":0}," : "") +
         "\"metallicFactor\":0,\"roughnessFactor\":" + decimalText(roughness) + '}' + extras + '}';
}

/// Returns the glTF scene as JSON. Buffer views 2p and 2p + 1 are the vertices and indices of primitive p; an
/// additional last view is the image of the texture, if there is one.
std::string sceneText(const WorldMesh& mesh, const ExportInfo& info, const std::vector<Primitive>& primitives,
                      size_t buffer_bytes) {
  std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":" + quoted(info.generator) +
                     "},\"scene\":0,\"scenes\":[{\"extras\":" + extrasText(mesh, info);
  if (primitives.empty()) return json + "}]}";
  json += ",\"nodes\":[0]}],\"nodes\":[{\"name\":" + quoted(info.name) +
          ",\"mesh\":0}],\"meshes\":[{\"name\":" + quoted(info.name) + ",\"primitives\":";
  const bool textured = info.texture != nullptr, pictured = textured && !info.texture->png.empty();
  std::vector<std::string> accessors;
  json += listOf(primitives.size(), [&](size_t p) {
    const Primitive& primitive = primitives[p];
    const auto accessor = [&](size_t view, size_t offset, size_t count, const std::string& rest) {
      accessors.push_back("{\"bufferView\":" + std::to_string(view) + ",\"byteOffset\":" + std::to_string(offset) +
                          ",\"count\":" + std::to_string(count) + ",\"componentType\":" + rest + '}');
      return std::to_string(accessors.size() - 1);
    };
    size_t offset = 0;
    const auto attribute = [&](const char* name, size_t bytes, const std::string& rest) {
      const std::string number = accessor(2 * p, offset, primitive.vertices.size(), rest);
      offset += bytes;
      return '"' + std::string(name) + "\":" + number;
    };
    std::string attributes = attribute(
        "POSITION", 12,
        "5126,\"type\":\"VEC3\",\"min\":" + vectorText(primitive.low) + ",\"max\":" + vectorText(primitive.high));
    attributes += ',' + attribute("NORMAL", 12, "5126,\"type\":\"VEC3\"");
    attributes += ',' + attribute("_TAG", 4, "5123,\"type\":\"SCALAR\"");
    if (textured) {
      attributes += ',' + attribute("TEXCOORD_0", 8, "5126,\"type\":\"VEC2\"");
      attributes += ',' + attribute("_BLEND", 4, "5121,\"normalized\":true,\"type\":\"VEC4\"");
    }
    if (primitive.blends()) attributes += ',' + attribute("COLOR_0", 8, "5123,\"normalized\":true,\"type\":\"VEC4\"");
    return "{\"attributes\":{" + attributes + "},\"indices\":" +
           accessor(2 * p + 1, 0, primitive.indices.size(),
                    primitive.shortIndices() ? "5123,\"type\":\"SCALAR\"" : "5125,\"type\":\"SCALAR\"") +
           ",\"material\":" + std::to_string(p) + '}';
  });
  json += "}],\"materials\":" + listOf(primitives.size(), [&](size_t p) { return materialText(info, primitives[p]); });
  if (pictured) {
    json += ",\"textures\":[{\"source\":0}],\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":" +
            std::to_string(2 * primitives.size()) + "}]";
  }
  json += ",\"accessors\":" + listOf(accessors.size(), [&](size_t i) { return accessors[i]; });
  size_t offset = 0;
  json += ",\"bufferViews\":" + listOf(primitives.size() + (pictured ? 1 : 0), [&](size_t p) {
            if (p == primitives.size()) {
              return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                     ",\"byteLength\":" + std::to_string(info.texture->png.size()) + '}';
            }
            const Primitive& primitive = primitives[p];
            std::string views = "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                                ",\"byteLength\":" + std::to_string(primitive.vertexBytes()) +
                                ",\"byteStride\":" + std::to_string(primitive.vertex_size) + ",\"target\":34962},";
            offset += primitive.vertexBytes();
            views += "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                     ",\"byteLength\":" + std::to_string(primitive.indexBytes()) + ",\"target\":34963}";
            offset += primitive.paddedIndexBytes();
            return views;
          });
  return json + ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer_bytes) + "}]}";
}

void writeColour(const Float3& first, const Float3& second, uint8_t share, FileWriter& file) {
  for (size_t i = 0; i < 3; ++i) {
    const float mixed = first[i] + (second[i] - first[i]) * (static_cast<float>(share) / 255.0f);
    file.writeValue(static_cast<uint16_t>(std::clamp(mixed, 0.0f, 1.0f) * 65535.0f + 0.5f));
  }
  file.writeValue(uint16_t{65535});
}

void writePrimitive(const WorldMesh& mesh, const ExportInfo& info, const Primitive& primitive, FileWriter& file) {
  const ExportTexture* texture = info.texture;
  const Float3 first = materialAt(info, primitive.materials[0]).colour;
  const Float3 second = materialAt(info, primitive.materials[1]).colour;
  for (uint32_t number : primitive.vertices) {
    const uint32_t vertex = vertexOf(texture, number);
    const Float3 position = exportedPosition(mesh, vertex), normal = exportedNormal(mesh, vertex);
    file.write(position.data(), sizeof position);
    file.write(normal.data(), sizeof normal);
    file.writeValue(uint32_t{mesh.attributes[vertex].tag});
    if (texture != nullptr) {
      const auto& [u, v] = texture->coordinates[number];
      file.writeValue(u);
      file.writeValue(-v);  // texture coordinate v points down in glTF
      const ExportBlend& blend = texture->blends[number];
      file.write(blend.planes.data(), blend.planes.size());
      file.writeValue(blend.share);
      if (primitive.blends()) writeColour(first, second, blend.share, file);
    }
  }
  for (uint32_t index : primitive.indices) {
    if (primitive.shortIndices()) {
      file.writeValue(static_cast<uint16_t>(index));
    } else {
      file.writeValue(index);
    }
  }
  for (size_t i = primitive.indexBytes(); i < primitive.paddedIndexBytes(); ++i) file.write("\0", 1);
}

}  // namespace

Result<void> writeGlb(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file) {
  const std::vector<Primitive> primitives = splitByMaterial(mesh, info.texture);
  size_t buffer_bytes = 0;
  for (const Primitive& p : primitives) buffer_bytes += p.vertexBytes() + p.paddedIndexBytes();
  const size_t picture = info.texture != nullptr && !primitives.empty() ? info.texture->png.size() : 0;
  buffer_bytes += (picture + 3) / 4 * 4;
  std::string json = sceneText(mesh, info, primitives, buffer_bytes);
  json.append((4 - json.size() % 4) % 4, ' ');
  const size_t total = 12 + 8 + json.size() + (primitives.empty() ? 0 : 8 + buffer_bytes);
  if (total > std::numeric_limits<uint32_t>::max()) {
    return Error{Code::limit, "a .glb file holds at most 4 GiB, and this mesh needs " + std::to_string(total >> 20) +
                                  " MiB; mesh a smaller region or write .ply"};
  }
  file.write("glTF");
  file.writeValue(uint32_t{2});
  file.writeValue(static_cast<uint32_t>(total));
  file.writeValue(static_cast<uint32_t>(json.size()));
  file.write("JSON");
  file.write(json);
  if (!primitives.empty()) {
    file.writeValue(static_cast<uint32_t>(buffer_bytes));
    file.write("BIN\0", 4);
    for (const Primitive& p : primitives) writePrimitive(mesh, info, p, file);
    if (picture > 0) file.write(info.texture->png.data(), picture);
    for (size_t i = picture; i % 4 != 0; ++i) file.write("\0", 1);
  }
  return file.commit();
}

}  // namespace sgm
