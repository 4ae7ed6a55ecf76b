#pragma once
// What was done to a streamed world: brushes laid on its field, and another field in its place; what of that a frame
// does not show yet, and the journal of the brushes.

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

/// A world at one moment. All chunks of a frame are meshed under one and the same state, so that they fit together.
struct WorldState {
  uint64_t number = 0;                            ///< how many changes came before; two of one number are equal
  std::shared_ptr<const WorldField> field{};      ///< that the brushes lie on
  std::shared_ptr<const EditSnapshot> brushes{};  ///< null: none
};

/// What a change has touched.
struct WorldChange {
  uint64_t number = 0;                         ///< of the state that the change led to
  IntBox box{};                                ///< of a brush
  std::shared_ptr<const FieldChange> field{};  ///< of another field; then without a box
};

/// Thread-safe. Nothing here waits for the disk but open() and flush().
class WorldEdits {
 public:
  /// memory: as EditLog's.
  WorldEdits(std::shared_ptr<const WorldField> field, const EditSettings& settings, std::pmr::memory_resource* memory);

  /// Adds what a journal holds, and writes there from now on. Gives what is to be told of it (OpenedJournal::message).
  /// Once, before anything else. Errors: those of EditJournal::open and EditLog::merge.
  Result<std::string> open(const std::filesystem::path& path, const WorldIdentity& world);

  /// As EditLog's.
  Result<EditId> add(const Brush& brush);
  Result<EditId> undo(EditId id);
  Result<void> import(std::span<const std::byte> bytes);
  /// Lays the brushes on FieldChange::to() from now on; gives the state's number. New brushes may have the materials
  /// and tags of that field's grammar. Precondition: the change comes from state().field.
  uint64_t setField(std::shared_ptr<const FieldChange> change);
  std::vector<std::byte> exportBytes(uint64_t since) const;
  uint64_t size() const;
  uint64_t hash() const;

  /// Of the last state: never waits.
  uint64_t number() const { return number_.load(std::memory_order_acquire); }
  WorldState state() const;
  /// What has changed after the state of this number, up to state().
  std::vector<WorldChange> changedSince(uint64_t number) const;
  /// Nobody will ask for what changed up to this state any more.
  void forget(uint64_t number);

  /// Whether there is something to write that flush() has not tried to write.
  bool unwritten() const { return unwritten_.load(std::memory_order_acquire); }
  /// Returns when the disk has every operation of before. Errors: as EditJournal::flush; unwritten() holds again, also
  /// where it throws std::bad_alloc.
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
  uint64_t journalled_ = 0;  ///< operations that the journal has taken

  std::unique_ptr<EditJournal> journal_;  ///< null: none; set once
  std::atomic<uint64_t> number_{0};
  std::atomic<bool> unwritten_{false};
};

}  // namespace sgm
