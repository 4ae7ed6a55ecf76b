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
  /// The classification limits that were used; limits.key is also the key of all histograms.
  measure::MasterLimits limits;
  measure::Histogram histogram;
  std::string from;  ///< origin of the reference histograms: the database's path, or "built in"
  /// For each class of said.classes, in that order: the reference histogram with the smallest mse.
  std::vector<measure::Master> nearest;
};

/// Classifies a mesh with the database's reference histograms of a histogram mode. density: grid cells per metre of the
/// mesh; 0 if unknown. Errors: invalid_argument if there are no histograms for mode and density; those of
/// innerHistogram and classify.
Result<Classified> classifyTriangles(const asset::TriangleMesh& mesh, const std::string& mode, double density,
                                     const masters::OpenedBase& base, JobSystem& jobs);

/// The classification as JSON for `sgm classify --json`, without the members about the file or region.
Json toJson(const Classified& classified);
/// The classification as lines of text. what: name of the classified file or region.
std::string textOf(const Classified& classified, const std::string& what);

}  // namespace sgm::cli
