#pragma once
// The subcommands of `sgm`, one source each: what they are asked, and what runs. How the command line asks is in
// arguments.cpp alone.

#include <string>
#include <vector>

#include "base/file_writer.h"
#include "cli/console.h"
#include "cli/options.h"

namespace sgm::cli {

/// Of this process: a signal handler has nothing else to hold on to. In main.cpp.
extern UnfinishedFiles unfinished_files;

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

struct MeshOptions : WorldOptions {
  std::string out;  ///< empty: measure only
};
Exit mesh(const MeshOptions& options);

struct RenderOptions : WorldOptions {
  std::string out;
  std::string camera;
  std::string at;
  std::string size = "1280x720";
  double fov = 68;
};
Exit render(const RenderOptions& options);

Exit listBackends(bool json);

/// Reads the command line and runs what it asks for.
Exit runCommandLine(int argc, char** argv);

}  // namespace sgm::cli
