#include "asset/read/glb_material.h"

#include "asset/read/glb_transform.h"
#include "asset/read/mesh_limits.h"
#include "base/math.h"

namespace sgm::asset {

namespace {

const JsonValue* find(const JsonValue* of, std::string_view name) { return of == nullptr ? nullptr : of->find(name); }

/// The most visible texture of a material, and its JSON pointer in the file.
struct Texture {
  const JsonValue* info = nullptr;
  std::string pointer;
};

Texture firstTexture(const JsonValue& material) {
  const JsonValue* const extensions = material.find("extensions");
  const std::pair<const JsonValue*, std::string_view> kHolders[] = {
      {material.find("pbrMetallicRoughness"), "/pbrMetallicRoughness"},
      {find(extensions, "KHR_materials_pbrSpecularGlossiness"), "/extensions/KHR_materials_pbrSpecularGlossiness"},
      {&material, ""}};
  constexpr std::string_view kNames[] = {"baseColorTexture", "diffuseTexture",   "metallicRoughnessTexture",
                                         "normalTexture",    "occlusionTexture", "emissiveTexture"};
  for (const std::string_view name : kNames)
    for (const auto& [holder, pointer] : kHolders)
      if (const JsonValue* info = find(holder, name)) return {info, std::string(pointer) + "/" + std::string(name)};
  return {};
}

}  // namespace

TextureCoordinates GlbTextureTransform::operator()(const TextureCoordinates& at) const {
  // The rotation is counter-clockwise in image space, where the second coordinate grows downward.
  const double u = scale[0] * double{at[0]}, v = scale[1] * double{at[1]};
  return {static_cast<float>(offset[0] + cosine * u + sine * v), static_cast<float>(offset[1] - sine * u + cosine * v)};
}

Result<std::vector<GlbMaterial>> readGlbMaterials(const JsonValue& root) {
  std::vector<GlbMaterial> out;
  for (const JsonValue& value : root.list("materials")) {
    GlbMaterial& material = out.emplace_back();
    if (const JsonValue* name = value.find("name")) material.name = name->text;
    const Texture texture = firstTexture(value);
    if (texture.info == nullptr) continue;
    material.coordinates = texture.info->count("texCoord").value_or(0);
    const JsonValue* const transform = find(texture.info->find("extensions"), "KHR_texture_transform");
    if (transform == nullptr) continue;
    material.coordinates = transform->count("texCoord").value_or(material.coordinates);
    GlbTextureTransform& laid = material.transform.emplace();
    const JsonValue* const rotation = transform->find("rotation");
    constexpr double kMaxTurned = 1e6;
    const bool turned = rotation == nullptr || (rotation->kind == JsonValue::Kind::number &&
                                                rotation->number >= -kMaxTurned && rotation->number <= kMaxTurned);
    if (!turned || !readNumbers(*transform, "offset", laid.offset) || !readNumbers(*transform, "scale", laid.scale))
      return wrongInJson(
          "a texture transform has values that are not numbers, or a wrong count of them",
          "/materials/" + std::to_string(out.size() - 1) + texture.pointer + "/extensions/KHR_texture_transform");
    if (rotation == nullptr) continue;
    laid.cosine = detCos(rotation->number);
    laid.sine = detSin(rotation->number);
  }
  return out;
}

}  // namespace sgm::asset
