#pragma once
// The commands that serve others: the metrics service and the language server.

#include "tools/support/console.h"
#include "tools/support/serving.h"

namespace sgm::cli {

struct ServeOptions {
  ServingOptions serving;
  bool json = false;
};
Exit serve(const ServeOptions& options);

/// The language server: standard input to standard output, until it is told to exit.
Exit serveLanguage();

}  // namespace sgm::cli
