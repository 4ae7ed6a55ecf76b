#pragma once
// `sgm bench paper` and `sgm paper`.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/support/console.h"

namespace sgm::cli {

struct BenchOptions {
  uint64_t runs = 10;
  std::vector<std::string> backends;  ///< empty: all that `auto` might choose
  unsigned threads = 0;
  uint64_t cells = 256;        ///< on the edge of a stage's cube
  std::optional<double> cell;  ///< metres, in place of `cells`
  bool json = false;
};
Exit benchPaper(const BenchOptions& options);

struct PaperOptions {
  std::string out;
  std::vector<std::string> only;  ///< parts of the report; empty: all
  bool quick = false;
  bool no_pictures = false;
  std::string backend = "auto";
  unsigned threads = 0;
  uint64_t seed = 1;
  bool json = false;
};
/// The values of --only, in the order of the report.
std::vector<std::string> paperParts();
Exit reproducePaper(const PaperOptions& options);

}  // namespace sgm::cli
