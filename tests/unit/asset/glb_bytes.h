#pragma once
// Makes the bytes of GLB files for tests.

#include <cstring>
#include <string>

#include "asset/triangle_mesh.h"

namespace sgm::asset {

inline void putWord(std::string& out, uint32_t word) {
  char bytes[4];
  std::memcpy(bytes, &word, 4);
  out.append(bytes, 4);
}

inline std::string glbOf(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string out;
  putWord(out, 0x46546C67);
  putWord(out, 2);
  putWord(out, static_cast<uint32_t>(12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size())));
  putWord(out, static_cast<uint32_t>(json.size()));
  putWord(out, 0x4E4F534A);
  out += json;
  if (binary.empty()) return out;
  putWord(out, static_cast<uint32_t>(binary.size()));
  putWord(out, 0x004E4942);
  return out + binary;
}

/// The bytes of a GLB file with one primitive for each material, without indices.
inline std::string glbOf(const TriangleMesh& mesh) {
  std::string binary, accessors, views, primitives, materials;
  std::vector<uint32_t> kinds;
  for (const uint32_t m : mesh.materials) {
    bool known = false;
    for (const uint32_t k : kinds) known = known || k == m;
    if (!known) kinds.push_back(m);
  }
  for (const std::string& name : mesh.material_names)
    materials += std::string(materials.empty() ? "" : ",") + "{\"name\":\"" + name + "\"}";
  for (size_t k = 0; k < kinds.size(); ++k) {
    const size_t first = binary.size();
    size_t count = 0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.materials[t] != kinds[k]) continue;
      for (const uint32_t corner : mesh.triangles[t]) {
        const Point& p = mesh.points[corner];
        const float v[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        binary.append(reinterpret_cast<const char*>(v), sizeof v);
        ++count;
      }
    }
    const std::string comma = k == 0 ? "" : ",", number = std::to_string(k);
    views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(first) +
             ",\"byteLength\":" + std::to_string(binary.size() - first) + "}";
    accessors += comma + "{\"bufferView\":" + number + ",\"componentType\":5126,\"count\":" + std::to_string(count) +
                 ",\"type\":\"VEC3\"}";
    primitives += comma + "{\"attributes\":{\"POSITION\":" + number + "}" +
                  (kinds[k] == kNoMaterial ? "" : ",\"material\":" + std::to_string(kinds[k])) + "}";
  }
  const std::string json = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]," +
                           (materials.empty() ? std::string() : "\"materials\":[" + materials + "],") +
                           "\"meshes\":[{\"primitives\":[" + primitives + "]}],\"accessors\":[" + accessors +
                           "],\"bufferViews\":[" + views +
                           "],\"buffers\":[{\"byteLength\":" + std::to_string(binary.size()) + "}]}";
  return glbOf(json, binary);
}

}  // namespace sgm::asset
