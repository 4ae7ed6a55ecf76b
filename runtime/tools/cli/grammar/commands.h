#pragma once
// Commands on the text of grammars: `sgm check`, `sgm fmt` and `sgm explain`.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

struct CheckOptions : WorldOptions {
  std::vector<std::string> files;
  bool expect = false;
  uint64_t seeds = 1;
};
Exit check(const CheckOptions& options);

struct FmtOptions {
  std::vector<std::string> files;
  bool write = false;
  bool check = false;
};
Exit format(const FmtOptions& options);

struct ExplainOptions : WorldOptions {
  std::string at;
};
Exit explain(const ExplainOptions& options);

}  // namespace sgm::cli
