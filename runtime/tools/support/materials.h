#pragma once
// The appearance of a grammar's materials, in files and in pictures.

#include <vector>

#include "grammar/syntax/program.h"
#include "mesh/export/export.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// One material for each of Program::materials; at least one. The first material, which has no name, is plain rock.
std::vector<RenderMaterial> renderMaterials(const Program& program);
std::vector<ExportMaterial> exportMaterials(const Program& program);

}  // namespace sgm::cli
