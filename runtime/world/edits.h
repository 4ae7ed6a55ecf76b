#pragma once
// All that was done to a world. Worlds that have exchanged their operations, in any order and any number of times, have
// equal sets of them, and so equal hashes and equal fields.
//
// The set only grows. A brush shows unless the latest undo or redo of it, by order, is an undo; so an undo may come
// before its brush, and of two worlds that undo and redo at one time all agree on one. One that names no brush does
// nothing.

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "field/compile.h"
#include "world/edit_snapshot.h"

namespace sgm {

struct EditSettings {
  /// Whose operations are made here. Nobody else's, and never used again where operations may have been lost, with a
  /// journal's last second for instance: best drawn at random for each log.
  uint64_t author = 1;
  /// The largest that a brush laid here may have. Those from elsewhere may have any: another grammar's, for instance.
  uint16_t most_material = 0xFFFF, most_tag = 0xFFFF;
  size_t most_operations = size_t{1} << 20;
};

/// Thread-compatible; its snapshots may be on any thread. The memory must be thread-safe, and outlive it and them.
class EditLog {
 public:
  struct Edited {
    EditId id;
    IntBox box;  ///< what it changes; empty where it changes nothing
  };

  explicit EditLog(EditSettings settings, std::pmr::memory_resource* memory = std::pmr::get_default_resource());
  /// Not copied: two would give the same numbers to different operations.
  EditLog(EditLog&&) = default;
  EditLog& operator=(EditLog&&) = default;

  /// The largest material and tag that a brush may have from now on, as EditSettings has them. What is there stays.
  void setLabels(uint16_t most_material, uint16_t most_tag) {
    settings_.most_material = most_material;
    settings_.most_tag = most_tag;
  }

  /// Lays a brush on top of all that is known here. Errors: checkBrush's; invalid_argument for a material or a tag that
  /// there is not; limit.
  Result<Edited> add(const Brush& brush);
  /// Undoes an operation: hides a brush or, of an undo, shows the brush again, or, of a redo, hides it again.
  /// invalid_argument: the operation is not known here, or names no brush that is. limit.
  Result<Edited> undo(EditId id);

  /// Adds what is not yet known; all or nothing, unless memory runs out. Gives what it changes, a box for each brush
  /// that comes or goes. bad_input: an operation that could not have been made, or is known here with another content.
  /// limit.
  Result<std::vector<IntBox>> merge(std::span<const EditOperation> operations);
  /// merge of what exportBytes gave somewhere. bad_input as well for any other bytes.
  Result<std::vector<IntBox>> import(std::span<const std::byte> bytes);

  /// How many operations are known. What is learned later comes after them in operations() and exportBytes().
  uint64_t size() const { return known_.size(); }
  /// In the order in which they were learned here, all but the first `since`; until another is learned.
  std::span<const EditOperation> operations(uint64_t since = 0) const;
  std::vector<std::byte> exportBytes(uint64_t since = 0) const;

  /// Of the set.
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
  std::pmr::map<EditId, size_t> places_;  ///< in known_
  std::pmr::map<EditId, Sight> sights_;   ///< by brush, known or not
  EditSnapshot shown_;
  uint64_t latest_ = 0;  ///< time
  uint64_t number_ = 0;  ///< the largest of our own
  uint64_t sum_ = 0;     ///< of the operations' checksums
  uint64_t batch_ = 0;   ///< the last one's number
};

/// Where chunks with cells of this edge, in units, must be meshed again after a change: those whose closed box meets
/// the result. It holds what their seams read of the next coarser level.
IntBox editReach(const IntBox& changed, int32_t cell);

/// The operations with which alone the same brushes show: those brushes, and each brush's latest undo or redo, so that
/// one that comes back from elsewhere is hidden again. And each author's last, so that numbers go on. A redo of what
/// was left out shows it once it has come back.
std::vector<EditOperation> essentialEdits(std::span<const EditOperation> operations);

}  // namespace sgm
