#pragma once
// The changes of a streamed world: brushes laid on its field, and replacements of the field. Also the changes that no
// frame shows yet, and the journal of the brushes.

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

/// A world at one moment. All chunks of a frame are meshed under the same state, so that they fit together.
struct WorldState {
  uint64_t number = 0;                            ///< number of changes before it; states with equal numbers are equal
  std::shared_ptr<const WorldField> field{};      ///< the field below the brushes
  std::shared_ptr<const EditSnapshot> brushes{};  ///< null: none
};

/// The effect of a change.
struct WorldChange {
  uint64_t number = 0;                         ///< of the state after the change
  IntBox box{};                                ///< of a brush
  std::shared_ptr<const FieldChange> field{};  ///< of a new field, then without a box
};

/// Thread-safe. Only open() and flush() wait for the disk.
class WorldEdits {
 public:
  /// memory: as EditLog's.
  WorldEdits(std::shared_ptr<const WorldField> field, const EditSettings& settings, std::pmr::memory_resource* memory);

  /// Adds the operations of a journal, and writes to it from now on. Returns a message for the log
  /// (OpenedJournal::message). Call once, before anything else. Errors: those of EditJournal::open and EditLog::merge.
  Result<std::string> open(const std::filesystem::path& path, const WorldIdentity& world);

  /// As in EditLog.
  Result<EditId> add(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> import(std::span<const std::byte> bytes);
  /// Replaces the field below the brushes by FieldChange::to(); returns the state's number. New brushes may have the
  /// materials and tags of that field's grammar. Precondition: the change comes from state().field.
  uint64_t setField(std::shared_ptr<const FieldChange> change);
  std::vector<std::byte> exportBytes(uint64_t since) const;
  uint64_t size() const;
  uint64_t hash() const;

  /// The number of the current state; never waits.
  uint64_t number() const { return number_.load(std::memory_order_acquire); }
  WorldState state() const;
  /// The changes after the state of this number, up to state().
  std::vector<WorldChange> changedSince(uint64_t number) const;
  /// Drops changes up to this state: changedSince() will not be called with an earlier one.
  void forget(uint64_t number);

  /// Whether there are operations that flush() has not tried to write.
  bool unwritten() const { return unwritten_.load(std::memory_order_acquire); }
  /// Blocks until all operations so far are on disk. Errors: as EditJournal::flush; unwritten() is true again, also if
  /// it throws std::bad_alloc.
  Result<void> flush();

 private:
  void makeRoom(size_t more);
  void changed(std::span<const IntBox> boxes);
  template <class Merge>
  Result<void> merge(const Merge& from);

  mutable std::mutex mutex_;  ///< guards what follows
  EditLog log_;
  std::shared_ptr<const WorldField> field_;
  std::vector<WorldChange> changes_;
  uint64_t journalled_ = 0;  ///< operations that were passed to the journal

  std::unique_ptr<EditJournal> journal_;  ///< or null; set once
  std::atomic<uint64_t> number_{0};
  std::atomic<bool> unwritten_{false};
};

}  // namespace sgm
