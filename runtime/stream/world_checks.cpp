#include "stream/world_checks.h"

#include <cmath>
#include <string>

#include "base/plain_text.h"
#include "stream/world_core.h"

namespace sgm {

namespace {

std::string metres(double units) { return generalText(units / kUnitsPerMetre) + " m"; }

Result<void> checkLod(const LodSettings& lod) {
  if (lod.top < 0 || lod.top > kMaxLevel) {
    return Error{Code::invalid_argument, "the coarsest level is not between 0 and " + std::to_string(kMaxLevel)};
  }
  if (!(lod.finest_distance > 0) || !(lod.view_distance > 0) || !std::isfinite(lod.finest_distance) ||
      !std::isfinite(lod.view_distance)) {
    return Error{Code::invalid_argument, "the finest and the view distance must be finite and above 0"};
  }
  const LodViewer one;
  if (expectedLeaves({&one, 1}, lod) <= kMaxExpectedLeaves) return {};
  LodSettings near = lod;
  near.finest_distance = lod.finest_cell;
  const bool views_too_far = expectedLeaves({&one, 1}, near) > kMaxExpectedLeaves / 2;
  return Error{Code::limit, views_too_far ? "a view distance of " + metres(lod.view_distance) +
                                                " needs too many chunks of level " + std::to_string(lod.top) +
                                                ": raise the coarsest level, or lower the view distance"
                                          : "a finest distance of " + metres(lod.finest_distance) +
                                                " needs too many chunks of level 0: lower it, or use larger cells"};
}

/// Checks the host fields. With a disk cache, stores or a journal, each host field needs an identity, because data on
/// disk is identified by it.
Result<void> checkHosts(const WorldField& field, const WorldSettings& settings) {
  if (settings.journal.empty() && settings.cache.empty() && settings.baked == nullptr) return {};
  for (const HostField& host : field.settings().hosts) {
    if (host.identity != 0) continue;
    return Error{Code::invalid_argument,
                 "a host field has the identity 0: its data on disk could not be told apart from another field's"};
  }
  return {};
}

}  // namespace

Result<void> checkWorld(const WorldField& field, const WorldSettings& settings, size_t threads) {
  if (Result<void> good = checkLod(settings.lod); !good) return good;
  const size_t least = largestChunk(settings) * (threads + 2);
  if (settings.mesh_bytes < least) {
    return Error{Code::limit, "mesh_bytes is " + std::to_string(settings.mesh_bytes) + ", too small for streaming: " +
                                  std::to_string(threads) + " threads need " + std::to_string(least)};
  }
  return checkHosts(field, settings);
}

Result<void> checkSuccessor(const WorldField& next, const WorldField& current, const WorldSettings& settings) {
  const double cell = next.settings().finest_cell, own = settings.lod.finest_cell;
  if (cell != own) {
    return Error{Code::invalid_argument, "the field's finest cell is " + metres(cell) + ", but the world's is " +
                                             metres(own) +
                                             ": create the field with the world's cell, or create another world"};
  }
  if (next.isAlone() || current.isAlone()) {
    return Error{Code::unsupported, "a world without a grammar cannot be compared with another"};
  }
  return checkHosts(next, settings);
}

}  // namespace sgm
