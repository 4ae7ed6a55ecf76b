#pragma once
// The signs of those chunks that are being looked at, and where they come from.

#include <functional>
#include <map>
#include <optional>
#include <span>

#include "base/jobs.h"
#include "mesh/clearance.h"
#include "query/queries.h"

namespace sgm {

/// A lattice of samples, a cell apart: sample (x, y, z) lies at that times the cell, and chunk (x, y, z) has the
/// samples from 32 times that on.
struct SignField {
  /// The signs of a chunk, which lies wholly inside the world. From any thread.
  std::function<Result<ChunkSigns>(Int3 chunk)> signs;
  int32_t cell = kUnitsPerMetre / 2;  ///< units
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

/// Level 0 of a field.
SignField signField(QueryField field);

/// Signs of chunks, kept until they are dropped. One thread's, but for at() and clearance().
class SignWindow {
 public:
  explicit SignWindow(const SignField& field) : field_(field) {}

  /// Asks for those of the chunks that are not here, on the job system. Errors: the field's; of several the first
  /// one's.
  Result<void> add(std::span<const Int3> chunks, JobSystem& jobs);
  /// Drops what keep(chunk) does not hold of.
  template <class Keep>
  void dropUnless(const Keep& keep) {
    std::erase_if(chunks_, [&](const auto& entry) { return !keep(entry.first); });
  }

  /// Precondition: it is here.
  const ChunkSigns& at(Int3 chunk) const { return chunks_.at(chunk); }
  /// mesh/clearance.h. Precondition: the chunk is here; where most > 1, the 26 around it are too.
  std::pmr::vector<uint16_t> clearance(Int3 chunk, int most) const;

 private:
  const SignField& field_;
  std::map<Int3, ChunkSigns> chunks_;
};

/// The chunks that differ from this one by at most `rings` on each axis.
std::vector<Int3> chunksAround(Int3 chunk, int rings);

}  // namespace sgm
