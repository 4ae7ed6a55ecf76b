#pragma once
// Reads the part of a glTF file's materials that a mesh needs: their names, and which texture coordinates they use.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asset/triangle_mesh.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// A texture's transform of its coordinates (KHR_texture_transform).
struct GlbTextureTransform {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double cosine = 1, sine = 0;

  TextureCoordinates operator()(const TextureCoordinates& at) const;
};

struct GlbMaterial {
  std::string name;
  /// n of the TEXCOORD_n that its first texture uses; that is the base colour's, if the material has one
  size_t coordinates = 0;
  std::optional<GlbTextureTransform> transform;
};

/// Reads all materials of a file. Error: bad_input, with the JSON pointer in the message.
Result<std::vector<GlbMaterial>> readGlbMaterials(const JsonValue& root);

}  // namespace sgm::asset
