// `sgm serve`: runs a web page and an HTTP interface that measure and classify meshes, until a signal ends the process.

#include <fmt/core.h>

#include <cstdio>

#include "tools/cli/serve/commands.h"
#include "tools/support/awaited_signals.h"
#include "tools/support/console.h"

namespace sgm::cli {

Exit serve(const ServeOptions& options) {
  AwaitedSignals signals;
  const Result<Serving> serving = Serving::start(options.serving);
  if (!serving) return reportError(serving.error());
  if (options.json) {
    fmt::print("{{\"work\": \"{}\", \"operations\": \"{}\"}}\n", serving->work(), serving->operations());
  } else {
    fmt::print("page {}/\nmetrics {}/metrics\nends with Ctrl-C\n", serving->work(), serving->operations());
  }
  std::fflush(stdout);
  signals.wait();
  return Exit::done;
}

}  // namespace sgm::cli
