// The reference histograms that are compiled into the program.

#include <array>

#include "tools/classify/base.h"

namespace sgm::masters {
namespace {

using measure::HistogramMode;

struct BuiltInKey {
  uint32_t bins;
  HistogramMode mode;
  double length, density;
  uint32_t version;
  double mse, emd;
  size_t masters;
};

struct BuiltInMaster {
  const char* class_name;
  const char* name;
  uint32_t models;
  std::array<uint32_t, 65> shares;
};

#include "tools/classify/built_in_masters.inc"

MasterSet readBuiltIn() {
  MasterSet set;
  const BuiltInMaster* from = kMasters;
  for (const BuiltInKey& k : kKeys) {
    const measure::MasterKey key{k.bins, k.mode, k.length, k.density, k.version};
    set.limits.push_back({key, k.mse, k.emd});
    for (size_t i = 0; i < k.masters; ++i, ++from) {
      measure::Master master{from->class_name, from->name, key, from->models, {}};
      for (size_t bin = 0; bin < measure::binsOf(key.settings()); ++bin)
        master.shares.push_back(from->shares[bin] / 1e6);
      set.masters.push_back(std::move(master));
    }
  }
  return set;
}

}  // namespace

MasterSet builtInMasters() { return readBuiltIn(); }

}  // namespace sgm::masters
