#pragma once
// The commands for worlds baked ahead of time.

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
  std::string out;                  ///< the store's folder
  std::string levels = "0..4";      ///< as for readLevels
  std::string shard;                ///< as for readShard; empty: all tiles, then a merge
  bool merge = false;               ///< merges finished shards
  uint64_t slurm = 0;               ///< number of shards, as jobs of Slurm; 0: bakes here
  std::vector<std::string> sbatch;  ///< options of these jobs
  bool detach = false;              ///< submits them without waiting
};
Exit bake(const BakeOptions& options);

struct StoreOptions {
  std::string store;
  std::string world;  ///< the beginning of its name; empty: all
  bool json = false;
};
Exit storeInfo(const StoreOptions& options);
Exit storeClean(const StoreOptions& options);

/// WorldOptions: with a file, chunks of that world are baked again.
struct StoreVerifyOptions : WorldOptions {
  std::string store;
  std::string world;
  uint64_t samples = 100;
  uint64_t draw = 1;  ///< seed of the random sample
};
Exit storeVerify(const StoreVerifyOptions& options);

struct StoreDiffOptions {
  std::string store, other;
  std::string from, to;  ///< worlds, by the beginning of their names; empty: the only ones
  bool list = false;
  bool json = false;
};
Exit storeDiff(const StoreDiffOptions& options);

}  // namespace sgm::cli
