#pragma once
// The part of a glTF file's materials that a mesh needs: names, and texture coordinates.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// The transform of a texture on its coordinates (KHR_texture_transform).
struct GlbTextureTransform {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double cosine = 1, sine = 0;

  TextureCoordinates operator()(const TextureCoordinates& at) const;
};

struct GlbMaterial {
  std::string name;
  size_t coordinates = 0;  ///< set TEXCOORD_n of its first texture: the base colour's, if there is one
  std::optional<GlbTextureTransform> transform;
};

/// Error: bad_input, with the JSON pointer in the message.
Result<std::vector<GlbMaterial>> readGlbMaterials(const JsonValue& root);

}  // namespace sgm::asset
