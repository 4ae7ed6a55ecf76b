#pragma once
// The commands that bake worlds: chunks are meshed ahead of time and kept in a store.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// The error message for a device whose meshes differ in some bits from the meshes of other devices. Such meshes must
/// not be stored.
inline constexpr const char* kNotExact =
    "the meshes of this device differ from those of other devices: use --backend cpu for a store";

struct BakeOptions : WorldOptions {
  std::string out;              ///< folder of the store to bake into
  std::string levels = "0..4";  ///< range of levels of detail, in the form of readLevels()
  /// The shard (part of the world's tiles) to bake, in the form of readShard(). Empty: all tiles are baked and then
  /// merged.
  std::string shard;
  bool merge = false;               ///< true: merges finished shards into the store instead of baking
  uint64_t slurm = 0;               ///< number of shards that Slurm bakes, each as a task of an array job; 0: this
                                    ///< process bakes
  std::vector<std::string> sbatch;  ///< options of the command sbatch for the jobs of Slurm
  bool detach = false;              ///< true: submits the jobs of Slurm without waiting for their end
};
Exit bake(const BakeOptions& options);

struct StoreOptions {
  std::string store;
  std::string world;  ///< beginning of the world's name; empty: all worlds of the store
  bool json = false;
};
Exit storeInfo(const StoreOptions& options);
Exit storeClean(const StoreOptions& options);

/// Options of `sgm store verify`. If WorldOptions names a grammar, some chunks of that grammar's world are baked again
/// and compared with the stored chunks.
struct StoreVerifyOptions : WorldOptions {
  std::string store;
  std::string world;
  uint64_t samples = 100;
  uint64_t draw = 1;  ///< seed of the random selection of the chunks that are compared
};
Exit storeVerify(const StoreVerifyOptions& options);

struct StoreDiffOptions {
  std::string store, other;
  std::string from, to;  ///< beginnings of the names of the two worlds to compare; empty: the store's only world
  bool list = false;
  bool json = false;
};
Exit storeDiff(const StoreDiffOptions& options);

}  // namespace sgm::cli
