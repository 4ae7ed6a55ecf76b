#include "tools/support/materials.h"

namespace sgm::cli {

std::vector<RenderMaterial> renderMaterials(const Program& program) {
  std::vector<RenderMaterial> materials;
  for (const std::pmr::string& name : program.materials) materials.push_back(materialByName(name));
  if (materials.empty()) materials.emplace_back();
  return materials;
}

std::vector<ExportMaterial> exportMaterials(const Program& program) {
  const std::vector<RenderMaterial> looks = renderMaterials(program);
  std::vector<ExportMaterial> materials;
  for (size_t i = 0; i < looks.size(); ++i) {
    const RenderMaterial& look = looks[i];
    const bool named = i < program.materials.size() && !program.materials[i].empty();
    materials.push_back({named ? std::string(program.materials[i]) : "default",
                         {look.colour.x, look.colour.y, look.colour.z},
                         look.roughness});
  }
  return materials;
}

}  // namespace sgm::cli
