#pragma once
// The commands about worlds baked ahead of time.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// What is said of a device whose meshes are not the same as all others'.
inline constexpr const char* kNotExact =
    "this device's meshes are not those of every other: take --backend cpu for a store";

struct BakeOptions : WorldOptions {
  std::string out;                  ///< the store's folder
  std::string levels = "0..4";      ///< as readLevels takes them
  std::string shard;                ///< as readShard takes it; empty: all, and merged
  bool merge = false;               ///< merge what shards have made
  uint64_t slurm = 0;               ///< so many shards as jobs of Slurm; 0: here
  std::vector<std::string> sbatch;  ///< options of these jobs
  bool detach = false;              ///< submit them, and do not wait
};
Exit bake(const BakeOptions& options);

struct StoreOptions {
  std::string store;
  std::string world;  ///< the beginning of one's name; empty: all
  bool json = false;
};
Exit storeInfo(const StoreOptions& options);
Exit storeClean(const StoreOptions& options);

/// WorldOptions: with a file, chunks of that world are baked again.
struct StoreVerifyOptions : WorldOptions {
  std::string store;
  std::string world;
  uint64_t samples = 100;
  uint64_t draw = 1;  ///< seed of what is drawn
};
Exit storeVerify(const StoreVerifyOptions& options);

struct StoreDiffOptions {
  std::string store, other;
  std::string from, to;  ///< worlds of theirs, by the beginning of their names; empty: the only ones
  bool list = false;
  bool json = false;
};
Exit storeDiff(const StoreDiffOptions& options);

}  // namespace sgm::cli
