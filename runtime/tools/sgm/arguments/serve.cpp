// The command that judges meshes for others, and the one that it has judge each.

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/cli/classify/commands.h"
#include "tools/cli/serve/commands.h"
#include "tools/sgm/arguments/add_commands.h"
#include "tools/sgm/arguments/serving_options.h"

namespace sgm::cli {

Command addServe(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("serve", "Judge meshes over HTTP, with a page for people and metrics for Prometheus");
  const auto options = std::make_shared<ServeOptions>();
  addServingOptions(*app, options->serving, nullptr);
  app->add_flag("--json", options->json, "Print where it listens as one line of JSON on standard output");
  app->footer(
      "Serves until SIGINT, SIGTERM or SIGHUP; then answers what was asked, for 5 s at most, and ends with status 0.\n"
      "To see a world stream: sgm fly GRAMMAR --serve. What the interface takes and answers says "
      "/api/v1/openapi.json.\n"
      "Example:\n"
      "  sgm serve\n"
      "  curl --data-binary @cave.glb -H 'Content-Type: model/gltf-binary' http://127.0.0.1:8464/api/v1/validate");
  return [options] { return serve(*options); };
}

Command addInspect(CLI::App& root) {
  CLI::App* app = root.add_subcommand("inspect", "Judge what stands on standard input, for the metrics service");
  app->group("");
  const auto options = std::make_shared<InspectOptions>();
  CLI::Option* kind = app->add_option("--kind", options->kind, "Of the file")
                          ->check(CLI::IsMember({"glb", "obj", "ply", "stl", "sgm"}));
  // What a client sent is judged as it came, and the last of several counts.
  for (const auto& [name, text] : {std::pair<const char*, std::string*>{"--name", &options->name},
                                   {"--region", &options->region},
                                   {"--cell", &options->cell},
                                   {"--seed", &options->seed}})
    app->add_option(name, *text)->take_last()->needs(kind);
  app->add_option("--set", options->sets)->allow_extra_args(false)->needs(kind);
  app->add_option("--memory", options->memory, "Megabytes (2^20 bytes) of address space")
      ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 24))
      ->capture_default_str();
  app->add_option("--seconds", options->seconds, "Seconds of processor time")
      ->check(CLI::Range(uint64_t{1}, uint64_t{86400}))
      ->capture_default_str();
  CLI::Option* masters = app->add_option("--masters", options->masters, "A base; without it those that are built in");
  CLI::Option* list =
      app->add_flag("--list-masters", options->list_masters, "Say which masters there are")->excludes(kind);
  CLI::Option* store = app->add_flag("--store-masters", options->store_masters, "Put masters into the base")
                           ->excludes(kind)
                           ->excludes(list)
                           ->needs(masters);
  app->footer("Example:\n  sgm inspect --kind glb <cave.glb");
  return [options, kind, list, store] {
    if (kind->count() + list->count() + store->count() == 0)
      return complain(Exit::usage, "--kind says of what kind the file on standard input is");
    return inspect(*options);
  };
}

}  // namespace sgm::cli
