#pragma once
// The appearance of a grammar's materials, for pictures and exported files.

#include <vector>

#include "grammar/syntax/program.h"
#include "mesh/export/export.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// The appearance of each of Program::materials; at least one. The first one has no name and looks like plain rock.
std::vector<RenderMaterial> renderMaterials(const Program& program);
std::vector<ExportMaterial> exportMaterials(const Program& program);

}  // namespace sgm::cli
