#include "tools/sgm/arguments/serving_options.h"
#include "tools/cli/fly/commands.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace sgm::cli {

void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs) {
  const std::vector<CLI::Option*> all{
      app.add_option("--listen", options.listen,
                     "Numeric address to listen on. One that other machines can reach needs --token-file")
          ->type_name("ADDRESS")
          ->capture_default_str(),
      app.add_option("--port", options.port, "Port of the page and /api/v1; 0: any free port")
          ->check(CLI::Range(0, 65535))
          ->capture_default_str(),
      app.add_option("--operations-port", options.operations_port,
                     "Port of /metrics, /healthz and /readyz; 0: any free port")
          ->check(CLI::Range(0, 65535))
          ->capture_default_str(),
      app.add_option(
             "--token-file", options.token_file,
             "Require the token in the first line of this file (at least 16 characters) as Authorization: Bearer")
          ->type_name("FILE"),
      app.add_option("--host", options.hosts,
                     "Name of this machine that clients may use, beside localhost and the address (repeatable)")
          ->type_name("NAME")
          ->allow_extra_args(false),
      app.add_option("--masters", options.masters,
                     "Database of reference histograms, from `sgm masters build`, which PUT /api/v1/masters replaces; "
                     "default: the built-in ones")
          ->type_name("FILE"),
      app.add_option(
             "--upload-folder", options.upload_folder,
             "Folder for the unnamed files of uploads during validation; default: the folder for temporary files")
          ->type_name("FOLDER"),
      app.add_option("--upload-mb", options.upload_mb, "Limit of the size of an upload in megabytes")
          ->check(CLI::Range(uint64_t{1}, uint64_t{4096}))
          ->capture_default_str(),
      app.add_option("--inspect-mb", options.memory_mb, "Limit of the memory to validate an upload in megabytes")
          ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 20))
          ->capture_default_str(),
      app.add_option("--inspect-seconds", options.seconds, "Limit of the time to validate an upload in seconds")
          ->check(CLI::Range(1, 86400))
          ->capture_default_str(),
      app.add_option("--inspect-jobs", options.jobs, "Number of uploads that are validated concurrently")
          ->check(CLI::Range(1, 64))
          ->capture_default_str(),
      app.add_option("--inspect-waiting", options.waiting,
                     "Number of uploads that may wait; further ones are rejected with status 503")
          ->check(CLI::Range(1, 4096))
          ->capture_default_str(),
  };
  for (CLI::Option* option : all)
    if (needs != nullptr) option->needs(needs);
}

void addFlightServing(CLI::App& app, FlyOptions& options) {
  CLI::Option* serve = app.add_flag(
      "--serve", options.serve, "Show the flight on a page and in metrics over HTTP while it runs, as sgm serve does");
  app.add_flag("--keep-serving", options.keep_serving,
               "Keep serving after the end of the flight, until SIGINT, SIGTERM or SIGHUP; then print the report")
      ->needs(serve);
  addServingOptions(app, options.serving, serve);
}

}  // namespace sgm::cli
