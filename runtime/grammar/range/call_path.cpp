#include "grammar/range/call_path.h"

#include <algorithm>

namespace sgm {

bool isStandard(const Program& program, uint32_t file) {
  return file != 0 && program.modules[file].path.starts_with("std/");
}

ExprId CallPath::writtenCaller(ExprId id) const {
  if (!isStandard(program_, program_.expr(id).span.file)) return kNoId;
  const auto written = std::find_if(calls_.rbegin(), calls_.rend(),
                                    [&](ExprId call) { return !isStandard(program_, program_.expr(call).span.file); });
  return written == calls_.rend() ? kNoId : *written;
}

}  // namespace sgm
