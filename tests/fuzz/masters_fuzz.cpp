// Parses arbitrary text as reference histograms that a client uploads: it must be rejected, or give a set that the
// database can store.

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string_view>

#include "tools/classify/set_json.h"

using namespace sgm;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const masters::ReadSet read = masters::readSet({reinterpret_cast<const char*>(data), size});
  const auto require = [](bool holds) {
    if (!holds) std::abort();
  };
  require(read.set.has_value() == read.what.empty());
  if (!read.set) return 0;
  require(!read.malformed && read.pointer.empty());
  for (const measure::Master& master : read.set->masters) {
    require(read.set->limitsOf(master.key) != nullptr);
    require(static_cast<bool>(measure::checkHistogram(master.key.settings())));
    require(master.shares.size() == measure::binsOf(master.key.settings()));
    require(std::fabs(std::accumulate(master.shares.begin(), master.shares.end(), 0.0) - 1) < 1e-9);
    require(!master.class_name.empty() && !master.name.empty());
  }
  for (const measure::MasterLimits& limits : read.set->limits)
    require(limits.mse >= 0 && limits.emd >= 0 && !read.set->of(limits.key).empty());
  return 0;
}
