#pragma once
// The commands that classify meshes, and `sgm inspect`, which examines an upload in a process of its own.

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
  SandboxOptions sandbox;  ///< for the reading of mesh files
};
Exit classifyMesh(const ClassifyOptions& options);

struct InspectOptions {
  std::string kind;        ///< "glb", "obj", "ply", "stl" or "sgm"
  std::string name;        ///< file name that the client sent, for display; may contain any text
  std::string masters;     ///< a file of reference histograms; empty: the built-in ones
  uint64_t memory = 2048;  ///< address space limit of this process, MB
  uint64_t seconds = 60;
  /// Lists or replaces the reference histograms instead of inspecting an upload.
  bool list_masters = false, store_masters = false;
  std::string region, cell, seed;  ///< options for a grammar, as the client sent them; empty: not sent
  std::vector<std::string> sets;
};
/// Reads the upload from standard input. Writes to standard output: uint64 size of the JSON, the JSON, uint64 size of
/// the preview, the preview.
Exit inspect(const InspectOptions& options);

struct MastersBuildOptions {
  std::string out;   ///< file to write; empty: the default database, unless `emit` is given
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
