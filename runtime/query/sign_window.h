#pragma once
// Keeps the signs of the samples of some chunks in memory, and loads them from the field.

#include <functional>
#include <map>
#include <optional>
#include <span>

#include "base/jobs.h"
#include "mesh/clearance.h"
#include "query/queries.h"

namespace sgm {

/// The signs of a lattice of samples one cell apart: sample (x, y, z) lies at (x, y, z) * cell, and chunk (x, y, z)
/// begins with sample 32 * (x, y, z).
struct SignField {
  /// Returns the signs of a chunk that lies wholly inside the world. Called from any thread.
  std::function<Result<ChunkSigns>(Int3 chunk)> signs;
  int32_t cell = kUnitsPerMetre / 2;  ///< units
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// Returns the signs of a field's samples of level 0.
SignField signField(QueryField field);

/// Keeps the signs of chunks in memory until they are dropped. Not thread-safe, except at() and clearance().
class SignWindow {
 public:
  explicit SignWindow(const SignField& field) : field_(field) {}

  /// Loads those of the chunks that are missing, on the job system. Errors: those of the field; if several chunks fail,
  /// the error of the first chunk.
  Result<void> add(std::span<const Int3> chunks, JobSystem& jobs);
  /// Drops the chunks for which keep(chunk) is false.
  template <class Keep>
  void dropUnless(const Keep& keep) {
    std::erase_if(chunks_, [&](const auto& entry) { return !keep(entry.first); });
  }

  /// Returns the signs of a chunk. Precondition: the chunk is loaded.
  const ChunkSigns& at(Int3 chunk) const { return chunks_.at(chunk); }
  /// Returns the squared clearance of a chunk's samples (squaredClearance in mesh/clearance.h). Precondition: the chunk
  /// is loaded and, if most > 1, also the 26 chunks around it.
  std::pmr::vector<uint16_t> clearance(Int3 chunk, int most) const;

 private:
  const SignField& field_;
  std::map<Int3, ChunkSigns> chunks_;
};

/// Returns the chunk, and all chunks whose coordinates differ from its own by at most `rings` on each axis.
std::vector<Int3> chunksAround(Int3 chunk, int rings);

}  // namespace sgm
