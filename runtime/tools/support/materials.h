#pragma once
// What a grammar's materials look like, in files and in pictures alike.

#include <vector>

#include "grammar/syntax/program.h"
#include "mesh/export/export.h"
#include "tools/render/scene.h"

namespace sgm::cli {

/// By index in Program::materials; at least one. The nameless first is plain rock.
std::vector<RenderMaterial> renderMaterials(const Program& program);
std::vector<ExportMaterial> exportMaterials(const Program& program);

}  // namespace sgm::cli
