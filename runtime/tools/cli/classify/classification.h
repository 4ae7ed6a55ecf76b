#pragma once
// The classification of a mesh, for `sgm classify` and `sgm inspect`.

#include <string>
#include <vector>

#include "asset/triangle_mesh.h"
#include "base/jobs.h"
#include "base/json.h"
#include "tools/classify/base.h"

namespace sgm::cli {

struct Classified {
  measure::Classification said;
  measure::MasterLimits limits;  ///< the limits used, and the key of all histograms
  measure::Histogram histogram;
  std::string from;  ///< origin of the reference histograms: the database's path, or "built in"
  /// The nearest reference histogram of each class by mse, in the order of said.classes.
  std::vector<measure::Master> nearest;
};

/// Classifies a mesh with the database's reference histograms for this mode. density: cells per metre of the mesh; 0 if
/// unknown. Errors: invalid_argument if there are no histograms for mode and density; those of innerHistogram and
/// classify.
Result<Classified> classifyTriangles(const asset::TriangleMesh& mesh, const std::string& mode, double density,
                                     const masters::OpenedBase& base, JobSystem& jobs);

/// The output of `sgm classify --json`, without the part about the file or region.
Json toJson(const Classified& classified);
/// The output as lines of text. what: name of the classified file or region.
std::string textOf(const Classified& classified, const std::string& what);

}  // namespace sgm::cli
