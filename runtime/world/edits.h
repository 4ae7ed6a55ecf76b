#pragma once
// The log of all edits of a world. Worlds that have exchanged their operations, in any order and any number of times,
// have equal sets of operations, and so equal hashes and equal fields.
//
// The set only grows. A brush is visible unless its latest undo or redo, by order, is an undo. So an undo may arrive
// before its brush, and worlds that undo and redo concurrently agree on the result. An undo or redo of an unknown brush
// has no effect.

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "field/compile.h"
#include "world/edit_snapshot.h"

namespace sgm {

struct EditSettings {
  /// The author of the operations made here, unique to this log. Never reuse a number after operations may have been
  /// lost (for example with a journal's last second): draw it at random for each log.
  uint64_t author = 1;
  /// The largest material and tag of brushes laid here. Imported brushes may have any: another grammar's, for instance.
  uint16_t most_material = 0xFFFF, most_tag = 0xFFFF;
  size_t most_operations = size_t{1} << 20;
};

/// Thread-compatible; its snapshots may be used by any thread. The memory must be thread-safe and outlive the log and
/// its snapshots.
class EditLog {
 public:
  struct Edited {
    EditId id;
    IntBox box;  ///< the changed region; empty if nothing changes
  };

  explicit EditLog(EditSettings settings, std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Not copied: two copies would give the same numbers to different operations.
  EditLog(EditLog&&) = default;
  EditLog& operator=(EditLog&&) = default;

  /// Sets the largest material and tag of brushes laid from now on (see EditSettings). Existing brushes stay.
  void setLabels(uint16_t most_material, uint16_t most_tag) {
    settings_.most_material = most_material;
    settings_.most_tag = most_tag;
  }

  /// Lays a brush on top of all known ones. Errors: those of checkBrush; invalid_argument (material or tag too large),
  /// limit.
  Result<Edited> add(const Brush& brush);
  /// Undoes an operation: hides a brush, shows it again (if `id` is an undo), or hides it again (if `id` is a redo).
  /// Errors: invalid_argument (the operation or its brush is unknown), limit.
  Result<Edited> undo(EditId id);

  /// Adds the operations that are not yet known; all or none, unless memory runs out. Returns what changes: a box for
  /// each brush that appears or disappears. Errors: bad_input (no log could have made an operation, or it is known with
  /// other content), limit.
  Result<std::vector<IntBox>> merge(std::span<const EditOperation> operations);
  /// merge() of the result of exportBytes(). bad_input also for any other bytes.
  Result<std::vector<IntBox>> import(std::span<const std::byte> bytes);

  /// How many operations are known. Operations that arrive later come after them in operations() and exportBytes().
  uint64_t size() const { return known_.size(); }
  /// The operations in order of arrival, without the first `since`. Valid until the next one arrives.
  std::span<const EditOperation> operations(uint64_t since = 0) const;
  std::vector<std::byte> exportBytes(uint64_t since = 0) const;

  /// A hash of the set of operations.
  uint64_t hash() const;
  std::shared_ptr<const EditSnapshot> snapshot() const;

 private:
  struct Sight {  ///< the latest undo or redo of a brush
    EditOrder order;
    bool hidden = false;
  };

  const EditOperation* find(EditId id) const;
  bool hidden(EditId brush) const;
  Result<void> checkLabels(const Brush& brush) const;
  Result<Edited> make(EditOperation operation);
  void makeRoom(size_t more);
  IntBox insert(const EditOperation& operation, uint64_t batch);

  EditSettings settings_;
  std::pmr::vector<EditOperation> known_;
  std::pmr::map<EditId, size_t> places_;  ///< indices into known_
  std::pmr::map<EditId, Sight> sights_;   ///< by brush, known or not
  EditSnapshot shown_;
  uint64_t latest_ = 0;  ///< time
  uint64_t number_ = 0;  ///< the largest number of our own operations
  uint64_t sum_ = 0;     ///< sum of the operations' checksums
  uint64_t batch_ = 0;   ///< number of the last batch
};

/// The region whose chunks with cells of this edge (units) must be meshed again after a change: those whose closed box
/// meets it. Includes what their seams read of the next coarser level.
IntBox editReach(const IntBox& changed, int32_t cell);

/// A subset of operations that shows the same brushes. It holds the visible brushes; each brush's latest undo or redo,
/// so that a brush that arrives again is hidden again; and each author's last operation, so that numbering continues. A
/// redo of an omitted brush shows it once it has arrived again.
std::vector<EditOperation> essentialEdits(std::span<const EditOperation> operations);

}  // namespace sgm
