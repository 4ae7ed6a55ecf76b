#pragma once
// The log of all edits of a world. Worlds that have exchanged their operations, in any order and any number of times,
// have equal sets of operations, and therefore equal hashes and equal fields.
//
// Operations are never removed. A brush is visible unless its latest undo or redo, by EditOrder, is an undo. So an undo
// may arrive before its brush, and worlds that undo and redo concurrently agree on the result. An undo or redo of an
// unknown brush has no effect.

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "field/compile.h"
#include "world/edit_snapshot.h"

namespace sgm {

struct EditSettings {
  /// The author of the operations created by this log; no other log may use the same number. Draw it at random for each
  /// log: a number must not be used again after operations may have been lost (such as those of a journal's last
  /// second).
  uint64_t author = 1;
  /// The largest material and tag of brushes that add() accepts. Imported brushes may have larger ones, for example
  /// those of another grammar.
  uint16_t max_material = 0xFFFF, max_tag = 0xFFFF;
  size_t max_operations = size_t{1} << 20;
};

/// Not thread-safe, but its snapshots may be used by any thread. The memory resource must be thread-safe and outlive
/// the log and its snapshots.
class EditLog {
 public:
  struct Edited {
    EditId id;
    IntBox box;  ///< the region where the field changes; empty if nothing changes
  };

  explicit EditLog(EditSettings settings, std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Not copyable: two copies would give the same ids to different operations.
  EditLog(EditLog&&) = default;
  EditLog& operator=(EditLog&&) = default;

  /// Sets the largest material and tag of brushes that are added from now on (see EditSettings). Existing brushes are
  /// kept.
  void setLabels(uint16_t max_material, uint16_t max_tag) {
    settings_.max_material = max_material;
    settings_.max_tag = max_tag;
  }

  /// Adds a brush on top of all known brushes. Errors: those of checkBrush; invalid_argument (material or tag too
  /// large); limit.
  Result<Edited> add(const Brush& brush);
  /// Undoes an operation: hides the brush if `id` added it; shows it again if `id` is an undo; hides it again if `id`
  /// is a redo. Errors: invalid_argument (the operation or its brush is unknown); limit.
  Result<Edited> undo(EditId id);

  /// Adds the operations that are not yet known. If an error is returned, none is added; if memory runs out, some may
  /// have been added. Returns the regions that change: a box for each brush that appears or disappears. Errors:
  /// bad_input (no edit log could have created one of the operations, or two operations with the same id have different
  /// content); limit.
  Result<std::vector<IntBox>> merge(std::span<const EditOperation> operations);
  /// Decodes the result of exportBytes(), and merges its operations. Errors: those of merge(); bad_input if the bytes
  /// are not such a result.
  Result<std::vector<IntBox>> import(std::span<const std::byte> bytes);

  /// Returns the number of known operations. New operations are appended in operations() and exportBytes().
  uint64_t size() const { return known_.size(); }
  /// Returns the known operations in order of arrival, without the first `since`. Valid until the next operation
  /// arrives.
  std::span<const EditOperation> operations(uint64_t since = 0) const;
  std::vector<std::byte> exportBytes(uint64_t since = 0) const;

  /// Returns a hash of the set of operations, independent of their order of arrival.
  uint64_t hash() const;
  std::shared_ptr<const EditSnapshot> snapshot() const;

 private:
  struct Observation {  ///< the latest undo or redo of one brush
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
  std::pmr::map<EditId, size_t> places_;  ///< index in known_ of each operation
  /// the latest undo or redo of each brush, by the brush's id; the brush itself may not be known yet
  std::pmr::map<EditId, Observation> sights_;
  EditSnapshot shown_;
  uint64_t latest_ = 0;  ///< the largest time of all known operations
  uint64_t number_ = 0;  ///< the largest number among the operations of this log's author
  uint64_t sum_ = 0;     ///< sum of the checksums of all operations
  uint64_t batch_ = 0;   ///< number of the last batch of changes (EditSnapshot::with)
};

/// Returns the box that must be meshed again after the field has changed in the box `changed`: every chunk whose closed
/// box meets the result must be meshed again. cell: edge of the level's grid cells, in units. The result includes the
/// positions at which seams of these chunks sample the next coarser level.
IntBox editReach(const IntBox& changed, int32_t cell);

/// Returns a subset of the operations that makes the same brushes visible. It contains the visible brushes; the latest
/// undo or redo of each brush, so that a hidden brush stays hidden if it arrives again; and the last operation of each
/// author, so that numbering continues. A redo of a brush that was left out takes effect when the brush arrives again.
std::vector<EditOperation> essentialEdits(std::span<const EditOperation> operations);

}  // namespace sgm
