#pragma once
// Table 4 of the paper as it is printed, and which grammar and which options stand for each of its systems here.

#include <array>
#include <span>
#include <string>

namespace sgm::cli {

/// The columns of table 4, in its order.
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

/// What is classified as one kind of a world that has several.
struct Excerpt {
  const char* region = nullptr;  ///< null: what is measured otherwise too
  double cell = 0;
};

struct ComparedSystem {
  const char* name;  ///< as printed
  std::array<const char*, kCriteria> printed;
  const char* grammar;
  const char* region;  ///< that is measured; empty: all of a finite world
  double cell, quick_cell;
  const char* control;  ///< another value of a parameter
  const char* morph;    ///< of one that morphs; null where the grammar has none
  // What is drawn.
  const char *view_region, *camera;  ///< empty: as the renderer chooses
  double view_cell, quick_view_cell;
  uint64_t view_seed;
  const char* view_set;  ///< null: none
  bool sharp;
  const char* alt;
  const char* without;                ///< of what the paper says NO to, and of what is NO here: why
  std::array<Excerpt, 3> excerpts{};  ///< by the first three criteria
};

std::span<const ComparedSystem> comparedSystems();

}  // namespace sgm::cli
