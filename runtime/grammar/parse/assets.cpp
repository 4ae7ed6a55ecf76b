#include "grammar/parse/assets.h"

#include <bit>
#include <span>
#include <utility>

#include "asset/polyhedron.h"
#include "asset/read/mesh_file.h"
#include "asset/weld_triangles.h"
#include "base/hash.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Hashes only the content that is used, so that changes of other objects in the asset's file do not matter.
uint64_t hashOf(const asset::Polyhedron& solid, const std::vector<std::string>& materials) {
  uint64_t hash = hashText("asset");
  const auto add = [&](uint64_t value) { hash = hashCombine(hash, value); };
  for (const asset::Point& p : solid.points)
    for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<uint64_t>(p[axis]));
  for (size_t t = 0; t < solid.triangles.size(); ++t) {
    for (const uint32_t corner : solid.triangles[t]) add(corner);
    const uint32_t material = solid.faces[solid.face_of[t]].material;
    add(material == asset::kNoMaterial ? 0 : hashText(materials[material]));
  }
  return hash;
}

}  // namespace

std::optional<uint32_t> addAsset(Program& program, std::string_view path, std::string_view bytes, const Span& span,
                                 DiagnosticSink& sink) {
  const auto refuse = [&](const Error& error, std::string_view advice) {
    sink.error(span, error.code == Code::limit ? codes::kImportLimit : codes::kAsset,
               join({"cannot import `", path, "`: ", error.message}), std::string(advice));
    return std::nullopt;
  };
  std::optional<asset::MeshFileKind> kind = asset::MeshFileKind::glb;
  Result<asset::TriangleMesh> mesh = asset::readMeshOf(std::as_bytes(std::span(bytes)), kind);
  if (!mesh) return refuse(mesh.error(), asset::meshFileAdvice(*kind));
  for (const std::string& note : mesh->notes) sink.warning(span, codes::kAsset, join({"`", path, "`: ", note}));
  Result<asset::Polyhedron> solid = asset::makePolyhedron(*mesh);
  if (!solid)
    return refuse(solid.error(), solid.error().code == Code::limit ? asset::kSimplifyAdvice : asset::kOpenAdvice);
  Asset asset(program.assets.get_allocator().resource());
  asset.path = path;
  asset.hash = hashOf(*solid, mesh->material_names);
  for (const std::string& name : mesh->material_names) asset.material_names.emplace_back(name);
  asset.solid = std::make_shared<const asset::Polyhedron>(std::move(*solid));
  program.assets.push_back(std::move(asset));
  return static_cast<uint32_t>(program.assets.size() - 1);
}

}  // namespace sgm
