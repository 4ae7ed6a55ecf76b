#pragma once
// Reads what a mesh needs of a glTF file's materials: their names, and which texture coordinates they use.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// The transform that a texture applies to texture coordinates (KHR_texture_transform).
struct GlbTextureTransform {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double cosine = 1, sine = 0;

  TextureCoordinates operator()(const TextureCoordinates& at) const;
};

struct GlbMaterial {
  std::string name;
  /// n of the attribute TEXCOORD_n that the material's most visible texture uses, preferably its base colour texture
  size_t coordinates = 0;
  std::optional<GlbTextureTransform> transform;
};

/// Reads all materials of a file. Error: bad_input, with the JSON pointer in the message.
Result<std::vector<GlbMaterial>> readGlbMaterials(const JsonValue& root);

}  // namespace sgm::asset
