#pragma once
// The commands that bake worlds: chunks are meshed ahead of time and kept in a store.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// The error for a device whose meshes differ from those of other devices.
inline constexpr const char* kNotExact =
    "the meshes of this device differ from those of other devices: use --backend cpu for a store";

struct BakeOptions : WorldOptions {
  std::string out;              ///< the store's folder
  std::string levels = "0..4";  ///< range of levels of detail, in the form of readLevels()
  std::string shard;   ///< the part of the tiles to bake, in the form of readShard(); empty: all tiles, then a merge
  bool merge = false;  ///< merges finished shards into the store
  uint64_t slurm = 0;  ///< number of shards to bake as jobs of Slurm; 0: bakes in this process
  std::vector<std::string> sbatch;  ///< options of sbatch for these jobs
  bool detach = false;              ///< submits the jobs without waiting for them
};
Exit bake(const BakeOptions& options);

struct StoreOptions {
  std::string store;
  std::string world;  ///< the beginning of the world's name; empty: all worlds of the store
  bool json = false;
};
Exit storeInfo(const StoreOptions& options);
Exit storeClean(const StoreOptions& options);

/// Options of the verification of a store. If WorldOptions names a grammar, chunks of that world are baked again and
/// compared.
struct StoreVerifyOptions : WorldOptions {
  std::string store;
  std::string world;
  uint64_t samples = 100;
  uint64_t draw = 1;  ///< seed of the random sample
};
Exit storeVerify(const StoreVerifyOptions& options);

struct StoreDiffOptions {
  std::string store, other;
  std::string from, to;  ///< the worlds to compare, by the beginning of their names; empty: the only world of the store
  bool list = false;
  bool json = false;
};
Exit storeDiff(const StoreDiffOptions& options);

}  // namespace sgm::cli
