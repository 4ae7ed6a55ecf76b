#pragma once
// The commands that classify meshes, and `sgm inspect`, which examines an upload in its own process.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

struct ClassifyOptions : WorldOptions {
  /// A file of reference histograms; empty: the default database, or the built-in ones if it does not exist.
  std::string masters;
  std::string mode = "curvature";
  SandboxOptions sandbox;  ///< limits of the process that reads mesh files
};
Exit classifyMesh(const ClassifyOptions& options);

struct InspectOptions {
  std::string kind;        ///< file format of the upload: "glb", "obj", "ply", "stl" or "sgm"
  std::string name;        ///< file name that the client sent, for display; may contain any text
  std::string masters;     ///< a file of reference histograms; empty: the built-in ones
  uint64_t memory = 2048;  ///< address space limit of this process, MB
  uint64_t seconds = 60;
  /// Lists or replaces the reference histograms instead of inspecting an upload.
  bool list_masters = false, store_masters = false;
  /// Values of the options --region, --cell and --seed, as the client sent them; empty: not sent.
  std::string region, cell, seed;
  std::vector<std::string> sets;
};
/// Inspects an upload from standard input. Writes to standard output: uint64 size of the JSON, the JSON, uint64 size of
/// the preview, the preview.
Exit inspect(const InspectOptions& options);

struct MastersBuildOptions {
  std::string out;   ///< database file to write; empty: the default database, or none if `emit` is given
  std::string emit;  ///< C++ source file to write; empty: none
  uint64_t models = 12;
  uint64_t seed = 1;
  unsigned threads = 0;
};
Exit buildMasters(const MastersBuildOptions& options);

struct MastersListOptions {
  std::string file;  ///< a file of reference histograms, as ClassifyOptions::masters
  bool json = false;
};
Exit listMasters(const MastersListOptions& options);

}  // namespace sgm::cli
