#pragma once
// The commands that write a mesh, a picture or a survey.

#include <string>

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

struct MeshOptions : WorldOptions {
  std::string out;  ///< mesh file to write; empty: the mesh is only measured
};
Exit mesh(const MeshOptions& options);

/// Draws a picture, a contact sheet or a survey.
Exit render(const RenderOptions& options);

}  // namespace sgm::cli
