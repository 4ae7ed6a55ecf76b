#pragma once
// The commands that classify meshes, and the process that inspects an upload.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

struct ClassifyOptions : WorldOptions {
  std::string masters;  ///< a base; empty: the default base, or the built-in reference histograms
  std::string mode = "curvature";
  SandboxOptions sandbox;  ///< for the reading of mesh files
};
Exit classifyMesh(const ClassifyOptions& options);

struct InspectOptions {
  std::string kind;        ///< "glb", "obj", "ply", "stl" or "sgm"
  std::string name;        ///< the client's, for display; any text
  std::string masters;     ///< a base; empty: the built-in reference histograms
  uint64_t memory = 2048;  ///< MB
  uint64_t seconds = 60;
  bool list_masters = false, store_masters = false;  ///< does this alone
  std::string region, cell, seed;                    ///< of a grammar, as they were sent; empty: not sent
  std::vector<std::string> sets;
};
/// Standard input to standard output: uint64 size of the JSON, the JSON, uint64 size of the preview, the preview.
Exit inspect(const InspectOptions& options);

struct MastersBuildOptions {
  std::string out;   ///< empty: the default base, unless `emit` is given
  std::string emit;  ///< a source file; empty: none
  uint64_t models = 12;
  uint64_t seed = 1;
  unsigned threads = 0;
};
Exit buildMasters(const MastersBuildOptions& options);

struct MastersListOptions {
  std::string file;  ///< as ClassifyOptions::masters
  bool json = false;
};
Exit listMasters(const MastersListOptions& options);

}  // namespace sgm::cli
