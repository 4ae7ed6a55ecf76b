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
  measure::MasterLimits limits;  ///< and the key
  measure::Histogram histogram;
  std::string from;                      ///< source of the reference histograms
  std::vector<measure::Master> nearest;  ///< the nearest of each class by mse, in the order of said.classes
};

/// Uses the base's reference histograms for this mode. density: cells per metre of the mesh, 0 if unknown. Errors:
/// invalid_argument if there are none for mode and density; those of innerHistogram and classify.
Result<Classified> classifyTriangles(const asset::TriangleMesh& mesh, const std::string& mode, double density,
                                     const masters::OpenedBase& base, JobSystem& jobs);

/// The output of `sgm classify --json`, without the part about the file or region.
Json toJson(const Classified& classified);
/// The same as lines of text. what: the classified file or region.
std::string textOf(const Classified& classified, const std::string& what);

}  // namespace sgm::cli
