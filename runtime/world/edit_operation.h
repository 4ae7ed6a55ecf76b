#pragma once
// What was done to a world, operation by operation, and its bytes.

#include <compare>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "field/brush.h"

namespace sgm {

/// Names an operation in all worlds: its author, and its number among that author's, from 1. Zero names none.
struct EditId {
  uint64_t author = 0, number = 0;
  friend auto operator<=>(const EditId&, const EditId&) = default;
};

/// Later operations lie above earlier ones. The time is Lamport's: one more than any that its author knew.
struct EditOrder {
  uint64_t time = 0;
  EditId id;
  friend auto operator<=>(const EditOrder&, const EditOrder&) = default;
};

struct EditOperation {
  enum class Kind : uint8_t {
    brush,  ///< lays a brush
    undo,   ///< hides the brush that `target` laid
    redo,   ///< shows it again
  };
  Kind kind = Kind::brush;
  EditOrder order;
  EditId target;  ///< of an undo or a redo
  Brush brush;    ///< of a brush
};

inline constexpr uint64_t kMostEditTime = uint64_t{1} << 62;  ///< of times and of numbers; both begin at 1

/// invalid_argument, range: no log could have made it.
Result<void> checkEdit(const EditOperation& operation);

/// Appends the brush's bytes, the same for equal brushes whatever their unused members hold.
void encodeBrush(const Brush& brush, std::vector<std::byte>& bytes);

/// Appends the operation's bytes, the same for equal operations whatever their unused members hold.
void encodeEdit(const EditOperation& operation, std::vector<std::byte>& bytes);
/// The next operation. bad_input: there is none, or it is none that could have been made.
Result<EditOperation> decodeEdit(ByteReader& bytes);

inline constexpr size_t kLeastEditBytes = 41, kMostEditBytes = 75;  ///< of one operation

}  // namespace sgm
