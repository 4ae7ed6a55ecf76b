#pragma once
// Table 4 of the paper as printed, and the grammar and options that represent each of its systems in our measurements.

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

/// A part of a world with several kinds of objects; the part is classified as a single kind.
struct Excerpt {
  const char* region = nullptr;  ///< --region of the part; null: the whole measured region
  double cell = 0;
};

struct ComparedSystem {
  const char* name;  ///< name of the system as printed in the paper
  std::array<const char*, kCriteria> printed;
  const char* grammar;
  const char* region;  ///< the region that is measured, as for --region; empty: all of a finite world
  double cell, quick_cell;
  const char* control;  ///< an assignment NAME=VALUE that changes a parameter, to test the criterion "control"
  /// An assignment that changes a parameter for morphing; null if the grammar has no such parameter.
  const char* morph;
  // Options of the picture.
  const char *view_region, *camera;  ///< options --region and --camera; empty: the renderer chooses
  double view_cell, quick_view_cell;
  uint64_t view_seed;
  const char* view_set;  ///< an assignment for --set; null: none
  bool sharp;
  const char* alt;
  const char* without;                ///< reasons for a NO in the paper, and for a NO in our measurements
  std::array<Excerpt, 3> excerpts{};  ///< the classified parts for the first three criteria
};

std::span<const ComparedSystem> comparedSystems();

}  // namespace sgm::cli
