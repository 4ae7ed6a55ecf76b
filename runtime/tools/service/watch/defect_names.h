#pragma once
// Names of the kinds of defects in the service's output.

#include <sgm/sgm.h>

#include <array>

namespace sgm::service {

/// Names of the defects, indexed by sgm_defect.
inline constexpr std::array<const char*, SGM_DEFECT_SELF_INTERSECTION + 1> kDefectNames{
    "index",          "outside",   "misplaced",        "samples",     "degenerate",
    "flat",           "duplicate", "open_edge",        "turned_edge", "nonmanifold_edge",
    "pinched_vertex", "folded",    "self_intersection"};

}  // namespace sgm::service
