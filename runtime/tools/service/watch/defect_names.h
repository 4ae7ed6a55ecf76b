#pragma once
// Names of what can be wrong with a chunk, as the service tells them.

#include <sgm/sgm.h>

#include <array>

namespace sgm::service {

/// By sgm_defect.
inline constexpr std::array<const char*, SGM_DEFECT_SELF_INTERSECTION + 1> kDefectNames{
    "index",          "outside",   "misplaced",        "samples",     "degenerate",
    "flat",           "duplicate", "open_edge",        "turned_edge", "nonmanifold_edge",
    "pinched_vertex", "folded",    "self_intersection"};

}  // namespace sgm::service
