// Declares the command that starts the metrics service, and the command `inspect`, which that service runs for each
// upload.

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/cli/classify/commands.h"
#include "tools/cli/serve/commands.h"
#include "tools/sgm/arguments/add_commands.h"
#include "tools/sgm/arguments/serving_options.h"

namespace sgm::cli {

Command addServe(CLI::App& root) {
  CLI::App* app = root.add_subcommand("serve", "Validate meshes over HTTP, with a web page and metrics for Prometheus");
  const auto options = std::make_shared<ServeOptions>();
  addServingOptions(*app, options->serving, nullptr);
  app->add_flag("--json", options->json, "Print the addresses as one line of JSON on standard output");
  app->footer(
      "The service runs until SIGINT, SIGTERM or SIGHUP; then it answers pending requests, for 5 s at most, and\n"
      "ends with status 0. /api/v1/openapi.json describes the interface. To watch a world stream: sgm fly GRAMMAR\n"
      "--serve.\n"
      "Example:\n"
      "  sgm serve\n"
      "  curl --data-binary @cave.glb -H 'Content-Type: model/gltf-binary' http://127.0.0.1:8464/api/v1/validate");
  return [options] { return serve(*options); };
}

Command addInspect(CLI::App& root) {
  CLI::App* app = root.add_subcommand("inspect", "Validate the file on standard input, for the metrics service");
  app->group("");
  const auto options = std::make_shared<InspectOptions>();
  CLI::Option* kind = app->add_option("--kind", options->kind, "Kind of the file")
                          ->check(CLI::IsMember({"glb", "obj", "ply", "stl", "sgm"}));
  // These values come from a client and are checked later, in the sandboxed process. If an option is repeated, its last
  // value counts.
  for (const auto& [name, text] : {std::pair<const char*, std::string*>{"--name", &options->name},
                                   {"--region", &options->region},
                                   {"--cell", &options->cell},
                                   {"--seed", &options->seed}})
    app->add_option(name, *text)->take_last()->needs(kind);
  app->add_option("--set", options->sets)->allow_extra_args(false)->needs(kind);
  app->add_option("--memory", options->memory, "Limit of the address space in megabytes (2^20 bytes)")
      ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 24))
      ->capture_default_str();
  app->add_option("--seconds", options->seconds, "Limit of the processor time in seconds")
      ->check(CLI::Range(uint64_t{1}, uint64_t{86400}))
      ->capture_default_str();
  CLI::Option* masters =
      app->add_option("--masters", options->masters, "Database of reference histograms; default: the built-in ones");
  CLI::Option* list =
      app->add_flag("--list-masters", options->list_masters, "List the reference histograms")->excludes(kind);
  CLI::Option* store = app->add_flag("--store-masters", options->store_masters,
                                     "Write the reference histograms on standard input to the database")
                           ->excludes(kind)
                           ->excludes(list)
                           ->needs(masters);
  app->footer("Example:\n  sgm inspect --kind glb <cave.glb");
  return [options, kind, list, store] {
    if (kind->count() + list->count() + store->count() == 0)
      return reportError(Exit::usage, "--kind is missing: give the kind of the file on standard input");
    return inspect(*options);
  };
}

}  // namespace sgm::cli
