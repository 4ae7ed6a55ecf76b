#include "tools/sgm/arguments/serving_options.h"
#include "tools/cli/fly/commands.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace sgm::cli {

void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs) {
  const std::vector<CLI::Option*> all{
      app.add_option("--listen", options.listen,
                     "Address to listen on, in numbers. One that others can reach needs --token-file")
          ->type_name("ADDRESS")
          ->capture_default_str(),
      app.add_option("--port", options.port, "Of the page and /api/v1; 0: any that is free")
          ->check(CLI::Range(0, 65535))
          ->capture_default_str(),
      app.add_option("--operations-port", options.operations_port,
                     "Of /metrics, /healthz and /readyz; 0: any that is free")
          ->check(CLI::Range(0, 65535))
          ->capture_default_str(),
      app.add_option("--token-file", options.token_file,
                     "Ask for the token in this file's first line, 16 characters or more, as Authorization: Bearer")
          ->type_name("FILE"),
      app.add_option("--host", options.hosts,
                     "A name of this machine that clients may use, beside localhost and the address (repeatable)")
          ->type_name("NAME")
          ->allow_extra_args(false),
      app.add_option("--masters", options.masters,
                     "A base of masters, from `sgm masters build`, which PUT /api/v1/masters replaces; without it the "
                     "masters that are built in")
          ->type_name("FILE"),
      app.add_option("--upload-folder", options.upload_folder,
                     "Where uploads lie while they are judged, without a name; without it in the machine's own folder "
                     "for temporary files")
          ->type_name("FOLDER"),
      app.add_option("--upload-mb", options.upload_mb, "Megabytes of one upload, at most")
          ->check(CLI::Range(uint64_t{1}, uint64_t{4096}))
          ->capture_default_str(),
      app.add_option("--inspect-mb", options.memory_mb, "Megabytes of memory to judge one upload, at most")
          ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 20))
          ->capture_default_str(),
      app.add_option("--inspect-seconds", options.seconds, "Seconds to judge one upload, at most")
          ->check(CLI::Range(1, 86400))
          ->capture_default_str(),
      app.add_option("--inspect-jobs", options.jobs, "Uploads that are judged at one time")
          ->check(CLI::Range(1, 64))
          ->capture_default_str(),
      app.add_option("--inspect-waiting", options.waiting,
                     "Uploads that may wait beside those; more are told to come again")
          ->check(CLI::Range(1, 4096))
          ->capture_default_str(),
  };
  for (CLI::Option* option : all)
    if (needs != nullptr) option->needs(needs);
}

void addFlightServing(CLI::App& app, FlyOptions& options) {
  CLI::Option* serve =
      app.add_flag("--serve", options.serve,
                   "Show the flight on a page and in metrics over HTTP, as sgm serve does, while it goes on");
  app.add_flag("--keep-serving", options.keep_serving,
               "Serve on when the flight has ended, until SIGINT, SIGTERM or SIGHUP; the report comes then")
      ->needs(serve);
  addServingOptions(app, options.serving, serve);
}

}  // namespace sgm::cli
