#pragma once
// What several commands are asked for on the command line, and checks of what is given: "" or what is wrong.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/sgm/arguments/add_commands.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// As CLI::Range, which lets what is not a number pass, and says that 0 is not within 0.000000 and more.
CLI::Validator numberIn(double low, double high);

std::string checkRegion(const std::string& text);
/// Signed text would wrap round into an unsigned number.
std::string checkWhole(const std::string& text);
std::string checkSet(const std::string& text);
std::string checkMeshFile(const std::string& out);
std::string checkSize(const std::string& text);
std::string checkPoint(const std::string& text);
std::string checkCamera(const std::string& text);
std::string checkLevels(const std::string& text);
std::string checkShard(const std::string& text);
std::string checkPng(const std::string& out);
/// .png or .svg.
std::string checkPicture(const std::string& out);
std::string checkCutLine(const std::string& text);
std::string checkSeeds(const std::string& text);
std::string checkVideo(const std::string& out);

void addLevelOption(CLI::App& app, WorldOptions& options);
/// --seed, --set, --backend, --threads.
void addDerivationOptions(CLI::App& app, WorldOptions& options);
/// FILE, --json, and those of addDerivationOptions.
void addWorldOptions(CLI::App& app, WorldOptions& options);
/// --region, --cell, --ld, --max-chunks.
void addRegionOptions(CLI::App& app, WorldOptions& options);
void addSharpOption(CLI::App& app, WorldOptions& options);
/// --light, of pictures, and what --help says of it.
CLI::Option* addLightOption(CLI::App& app, std::string& light);
inline constexpr const char* kLightFooter =
    "Light: from where the picture's rays end (at most 256 m away) five more go up, into the world itself, whatever "
    "of\n"
    "it is meshed. Where 3 % of them or more come to the sky, or to glass, cloud or snow, the sun shines; else the\n"
    "camera has a head lamp. A camera in the rock itself looks by the sun at what is cut open.\n";

/// All options but these.
std::vector<CLI::Option*> optionsBeside(CLI::App& app, const std::vector<CLI::Option*>& others);

/// Of a process that reads a mesh file.
template <class Options>
void addProcessLimits(CLI::App& app, Options& options) {
  app.add_option("--memory", options.memory, "Megabytes (2^20 bytes) that a mesh file's reading and measuring may take")
      ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 24))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Seconds that it may take, of the clock and of all threads together")
      ->check(numberIn(0.1, 1e6))
      ->capture_default_str();
}

}  // namespace sgm::cli
