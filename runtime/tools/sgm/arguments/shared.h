#pragma once
// Options that several commands share, and functions that check the value of an option. A check returns an error
// message, or "" if the value is valid.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/sgm/arguments/add_commands.h"
#include "tools/support/options.h"
#include "tools/support/sandbox.h"

namespace sgm::cli {

/// Accepts numbers from low to high. CLI::Range is not used: it accepts text that is not a number, and prints limits as
/// 0.000000.
CLI::Validator numberIn(double low, double high);

std::string checkRegion(const std::string& text);
/// Accepts whole numbers without a sign. CLI11 would convert a negative number to a large unsigned one.
std::string checkWhole(const std::string& text);
std::string checkSet(const std::string& text);
std::string checkMeshFile(const std::string& out);
std::string checkSize(const std::string& text);
std::string checkPoint(const std::string& text);
std::string checkCamera(const std::string& text);
std::string checkLevels(const std::string& text);
std::string checkShard(const std::string& text);
std::string checkPng(const std::string& out);
/// Accepts file names that end in .png or .svg.
std::string checkPicture(const std::string& out);
std::string checkCutLine(const std::string& text);
std::string checkSeeds(const std::string& text);
std::string checkVideo(const std::string& out);

void addLevelOption(CLI::App& app, WorldOptions& options);
/// Adds --seed, --set, --backend and --threads.
void addDerivationOptions(CLI::App& app, WorldOptions& options);
/// Adds FILE, --json and the options of addDerivationOptions().
void addWorldOptions(CLI::App& app, WorldOptions& options);
/// Adds --region, --cell, --ld and --max-chunks.
void addRegionOptions(CLI::App& app, WorldOptions& options);
void addSharpOption(CLI::App& app, WorldOptions& options);
/// Adds --light for pictures. The footer of the command's --help should include kLightFooter.
CLI::Option* addLightOption(CLI::App& app, std::string& light);
inline constexpr const char* kLightFooter =
    "Light: from the points where the rays of the picture end (at most 256 m away), five more rays each go up\n"
    "through the world, meshed or not. If at least 3 % of them reach the sky, or glass, cloud or snow, the sun\n"
    "shines; otherwise the camera has a head lamp. The sun also shines if the camera itself is inside rock.\n";

/// All options that have been added to the command so far, except `others`.
std::vector<CLI::Option*> optionsBeside(CLI::App& app, const std::vector<CLI::Option*>& others);

/// Adds --memory and --seconds, which limit the process that reads a mesh file.
void addSandboxLimits(CLI::App& app, SandboxOptions& options);
/// Adds --sandboxed, which --help does not list: askSandbox() passes it to the process that it starts.
void addSandboxed(CLI::App& app, SandboxOptions& options);

}  // namespace sgm::cli
