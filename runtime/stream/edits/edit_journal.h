#pragma once
// The edits of a world on disk: a head that names the world, then operations, each with its length and checksum.

#include <filesystem>
#include <memory>
#include <mutex>

#include "world/edit_operation.h"

namespace sgm {

/// Of which world a journal is.
struct WorldIdentity {
  uint64_t grammar = 0;  ///< hash of the grammar and its parameters
  uint64_t seed = 0;
  int32_t cell = 0;  ///< edge of the finest cell in units
};

struct OpenedJournal;

/// Thread-safe. Whatever happens, the process killed or the power lost, all that was flushed is there when the file is
/// opened again. The file is locked as long as the journal lives, so that nobody else has it open.
class EditJournal {
 public:
  /// Opens the file, or makes it. A damaged one is kept under another name, and what stood before the damage goes on in
  /// a new one. One in which most operations are essential no more (essentialEdits) is written anew without them.
  /// io: not readable or writable, no room. bad_input: no journal, or one of another version or world; it stays as it
  /// is. limit: somebody has it open, or it is larger than a gigabyte.
  static Result<OpenedJournal> open(const std::filesystem::path& path, const WorldIdentity& world);

  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;
  ~EditJournal();  ///< flushes; whoever wants to know how that went flushes before

  /// Takes operations into memory; never waits for the disk. Throws std::bad_alloc, and none is taken.
  void append(std::span<const EditOperation> operations);
  /// Writes what was appended, and returns when the disk has it: where it is called every second, on any thread but the
  /// frame's, no more than that second can be lost. io: nothing is lost, and the next call tries again; the message
  /// says how many operations the disk does not have.
  Result<void> flush();

 private:
  EditJournal(std::filesystem::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

  const std::filesystem::path path_;
  const int file_;
  std::mutex appending_, writing_;
  std::vector<std::byte> waiting_;    ///< guarded by appending_
  std::vector<std::byte> unwritten_;  ///< guarded by writing_
  uint64_t size_;                     ///< up to here the disk has the file; guarded by writing_
};

struct OpenedJournal {
  std::unique_ptr<EditJournal> journal;
  std::vector<EditOperation> operations;  ///< in the order in which they were written
  uint64_t cut_bytes = 0;                 ///< of a last operation that was not written to its end: they are gone
  size_t left_out = 0;                    ///< operations that were essential no more: they are gone
  std::filesystem::path damaged;          ///< where the damaged file is kept; empty: it was whole
  std::string message;                    ///< for the log, where something was not as it should be
};

}  // namespace sgm
