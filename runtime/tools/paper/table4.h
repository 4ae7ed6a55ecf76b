#pragma once
// Table 4 of the paper as printed, and the grammar and options that represent each of its systems here.

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

/// The part of a world with several kinds of objects that is classified as one kind.
struct Excerpt {
  const char* region = nullptr;  ///< null: the measured region
  double cell = 0;
};

struct ComparedSystem {
  const char* name;  ///< as printed
  std::array<const char*, kCriteria> printed;
  const char* grammar;
  const char* region;  ///< the measured one; empty: all of a finite world
  double cell, quick_cell;
  const char* control;  ///< a parameter with another value
  const char* morph;    ///< the same for morphing; null if the grammar has none
  // The picture.
  const char *view_region, *camera;  ///< empty: the renderer's choice
  double view_cell, quick_view_cell;
  uint64_t view_seed;
  const char* view_set;  ///< null: none
  bool sharp;
  const char* alt;
  const char* without;                ///< reasons for a NO of the paper, and for a NO here
  std::array<Excerpt, 3> excerpts{};  ///< by the first three criteria
};

std::span<const ComparedSystem> comparedSystems();

}  // namespace sgm::cli
