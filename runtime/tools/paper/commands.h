#pragma once
// The commands `sgm bench paper` and `sgm paper`.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/support/console.h"

namespace sgm::cli {

struct BenchOptions {
  uint64_t runs = 10;
  /// Names of the backends to measure; empty: all backends that `auto` might choose.
  std::vector<std::string> backends;
  unsigned threads = 0;
  uint64_t cells = 256;        ///< number of grid cells along the edge of the cube that is meshed
  std::optional<double> cell;  ///< edge of a grid cell in metres; replaces `cells`
  bool json = false;
};
Exit benchPaper(const BenchOptions& options);

struct PaperOptions {
  std::string out;
  std::vector<std::string> only;  ///< names of the parts of the report to make; empty: all
  bool quick = false;
  bool no_pictures = false;
  std::string backend = "auto";
  unsigned threads = 0;
  uint64_t seed = 1;
  bool json = false;
};
/// The names that --only accepts, in the order of the report.
std::vector<std::string> paperParts();
Exit reproducePaper(const PaperOptions& options);

}  // namespace sgm::cli
