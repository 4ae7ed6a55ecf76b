#pragma once
// What `sgm classify` and `sgm inspect` find out of which class a mesh is.

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
  std::string from;                      ///< where the masters are from
  std::vector<measure::Master> nearest;  ///< the nearest one of each class by mse, as said.classes has them
};

/// By the masters that a base has for this mode of histogram. density: cells per metre of the mesh, 0 where it is not
/// known. Errors: invalid_argument where there are no masters for these; those of innerHistogram and classify.
Result<Classified> classifyTriangles(const asset::TriangleMesh& mesh, const std::string& mode, double density,
                                     const masters::OpenedBase& base, JobSystem& jobs);

/// What `sgm classify --json` prints, without what it says of the file or region.
Json toJson(const Classified& classified);
/// The same in lines for people. what: was classified.
std::string textOf(const Classified& classified, const std::string& what);

}  // namespace sgm::cli
