#pragma once
// Table 4 of the paper as printed, and for each system in it, the grammar and options that represent it in our
// measurements.

#include <array>
#include <span>
#include <string>

namespace sgm::cli {

/// The columns of table 4, in the paper's order.
enum Criterion : size_t {
  kClouds,
  kArchitecture,
  kCaves,
  kDetail,
  kControl,
  kMorphing,
  kTexture,
  kHidden,
  kOverlapping,
  kHoles,
  kCriteria
};
inline constexpr std::array<const char*, kCriteria> kCriterionNames = {"Clouds",
                                                                       "Architecture",
                                                                       "Caves",
                                                                       "Level of detail",
                                                                       "Controls",
                                                                       "Shape morphing",
                                                                       "Texture mapping",
                                                                       "High surfaces removed",
                                                                       "Overlapping vertices removed",
                                                                       "No holes"};

/// A part of the measured region that contains one kind of object and is classified separately, since the whole region
/// contains several kinds.
struct Excerpt {
  const char* region = nullptr;  ///< region of the part, in the form of --region; null: the whole measured region
  double cell = 0;
};

struct ComparedSystem {
  const char* name;  ///< name of the system as printed in the paper
  std::array<const char*, kCriteria> printed;
  const char* grammar;
  const char* region;  ///< the measured region, in the form of --region; empty: the whole finite world
  double cell, quick_cell;
  const char* control;  ///< assignment NAME=VALUE that changes a parameter, to test the criterion kControl
  /// Assignment NAME=VALUE that changes the degree of morphing; null if the grammar has no such parameter.
  const char* morph;
  // The following members are options for the picture of the system.
  const char *view_region, *camera;  ///< values of --region and --camera; empty: chosen by the renderer
  double view_cell, quick_view_cell;
  uint64_t view_seed;
  const char* view_set;  ///< assignment for the option --set; null: none
  bool sharp;
  const char* alt;
  /// explains each NO, both in the paper's table and in our measurements
  const char* without;
  std::array<Excerpt, 3> excerpts{};  ///< parts of the region that are classified to test the criteria kClouds,
                                      ///< kArchitecture and kCaves, in this order
};

std::span<const ComparedSystem> comparedSystems();

}  // namespace sgm::cli
