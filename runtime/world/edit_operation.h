#pragma once
// The operations of a world's edit log, and their encoding.

#include <compare>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "field/brush.h"

namespace sgm {

/// Identifies an operation across all worlds: its author, and its number among that author's operations, from 1. Zero
/// is no operation.
struct EditId {
  uint64_t author = 0, number = 0;
  friend auto operator<=>(const EditId&, const EditId&) = default;
};

/// Later operations lie above earlier ones. The time is a Lamport clock: one more than any time that the author knew.
struct EditOrder {
  uint64_t time = 0;
  EditId id;
  friend auto operator<=>(const EditOrder&, const EditOrder&) = default;
};

struct EditOperation {
  enum class Kind : uint8_t {
    brush,  ///< lays a brush
    undo,   ///< hides the brush that `target` laid
    redo,   ///< shows that brush again
  };
  Kind kind = Kind::brush;
  EditOrder order;
  EditId target;  ///< of an undo or a redo
  Brush brush;    ///< of a brush
};

inline constexpr uint64_t kMostEditTime = uint64_t{1} << 62;  ///< upper limit of times and of numbers; both begin at 1

/// Errors: invalid_argument or range if no log could have made the operation.
Result<void> checkEdit(const EditOperation& operation);

/// Appends the brush's bytes. Equal brushes give equal bytes, whatever their unused members hold.
void encodeBrush(const Brush& brush, std::vector<std::byte>& bytes);

/// Appends the operation's bytes. Equal operations give equal bytes, whatever their unused members hold.
void encodeEdit(const EditOperation& operation, std::vector<std::byte>& bytes);
/// Reads the next operation. bad_input: the bytes end, or no log could have made the operation.
Result<EditOperation> decodeEdit(ByteReader& bytes);

inline constexpr size_t kLeastEditBytes = 41, kMostEditBytes = 75;  ///< of one operation

}  // namespace sgm
