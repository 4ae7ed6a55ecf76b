#pragma once
// The commands that run servers: the metrics service and the language server.

#include "tools/support/console.h"
#include "tools/support/serving.h"

namespace sgm::cli {

struct ServeOptions {
  ServingOptions serving;
  bool json = false;
};
Exit serve(const ServeOptions& options);

/// Runs the language server on standard input and output until the client sends the notification `exit`.
Exit serveLanguage();

}  // namespace sgm::cli
