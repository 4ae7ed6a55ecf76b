#pragma once
// All changes of a streamed world: its brushes (edits), and replacements of its field. Tracks the changes that are not
// drawn yet, and writes the brushes to the journal.

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "stream/edits/edit_journal.h"
#include "stream/edits/field_change.h"
#include "world/edits.h"

namespace sgm {

/// An immutable snapshot of a world's content. All chunks of a frame are meshed from the same state, so that they fit
/// together.
struct WorldState {
  /// number of changes that led to this state; equal numbers mean equal states
  uint64_t number = 0;
  std::shared_ptr<const WorldField> field{};      ///< the field to which the brushes are applied
  std::shared_ptr<const EditSnapshot> brushes{};  ///< the applied brushes; null: none
};

/// A change of a world's content, by a brush or by a new field.
struct WorldChange {
  uint64_t number = 0;  ///< number of the state after the change
  IntBox box{};         ///< for a brush: the changed region, in units
  /// for a new field: its difference from the previous field; box is unused in this case
  std::shared_ptr<const FieldChange> field{};
};

/// The current state of a world, and the changes that led to it. Thread-safe. Only open() and flush() wait for the
/// disk.
class WorldEdits {
 public:
  /// memory: passed to EditLog.
  WorldEdits(std::shared_ptr<const WorldField> field, const EditSettings& settings, std::pmr::memory_resource* memory);

  /// Loads the operations of a journal, and writes further operations to it. Returns a message for the log
  /// (OpenedJournal::message). Call it once, before all other functions. former: see EditJournal::open. Errors: those
  /// of EditJournal::open and EditLog::merge.
  Result<std::string> open(const std::filesystem::path& path, const WorldIdentity& world,
                           const FormerGrammar& former = {});

  /// These functions forward to EditLog, and record the changes.
  Result<EditId> add(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> import(std::span<const std::byte> bytes);
  /// Replaces the field by `change->to()`; returns the number of the new state. From now on, brushes may use the
  /// materials and tags of that field's grammar. Precondition: the change starts from state().field.
  uint64_t setField(std::shared_ptr<const FieldChange> change);
  std::vector<std::byte> exportBytes(uint64_t since) const;
  uint64_t size() const;
  uint64_t hash() const;

  /// Returns the number of the current state. Never waits.
  uint64_t number() const { return number_.load(std::memory_order_acquire); }
  WorldState state() const;
  /// Returns the changes between the state with this number and state().
  std::vector<WorldChange> changedSince(uint64_t number) const;
  /// Discards the changes up to the state with this number. changedSince() must not be called with an earlier number
  /// afterwards.
  void forget(uint64_t number);

  /// True if there are operations that flush() has not yet tried to write.
  bool unwritten() const { return unwritten_.load(std::memory_order_acquire); }
  /// Blocks until all operations so far are on disk. Errors: those of EditJournal::flush. After an error or
  /// std::bad_alloc, unwritten() is true again.
  Result<void> flush();

 private:
  void makeRoom(size_t more);
  void changed(std::span<const IntBox> boxes);
  template <class Merge>
  Result<void> merge(const Merge& from);

  mutable std::mutex mutex_;  ///< guards the members below
  EditLog log_;
  std::shared_ptr<const WorldField> field_;
  std::vector<WorldChange> changes_;
  uint64_t journalled_ = 0;  ///< number of operations that were passed to the journal

  std::unique_ptr<EditJournal> journal_;  ///< the journal file; null: none. Set once by open()
  std::atomic<uint64_t> number_{0};
  std::atomic<bool> unwritten_{false};
};

}  // namespace sgm
