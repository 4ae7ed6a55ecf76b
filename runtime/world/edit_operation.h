#pragma once
// The operations of a world's edit log, and their binary encoding.

#include <compare>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "field/brush.h"

namespace sgm {

/// Identifies an operation across all worlds: its author, and its number among that author's operations, from 1. Number
/// 0 means no operation.
struct EditId {
  uint64_t author = 0, number = 0;
  friend auto operator<=>(const EditId&, const EditId&) = default;
};

/// The order of operations: brushes of later operations lie above those of earlier ones. The time is a Lamport clock:
/// one more than any time that the author knew.
struct EditOrder {
  uint64_t time = 0;
  EditId id;
  friend auto operator<=>(const EditOrder&, const EditOrder&) = default;
};

struct EditOperation {
  enum class Kind : uint8_t {
    brush,  ///< adds a brush
    undo,   ///< hides the brush that `target` added
    redo,   ///< shows again the brush that `target` added
  };
  Kind kind = Kind::brush;
  EditOrder order;
  EditId target;  ///< for an undo or a redo: the operation whose brush is hidden, or shown again
  Brush brush;    ///< the brush that a brush operation adds
};

/// upper limit of times and of operation numbers; both start at 1
inline constexpr uint64_t kMaxEditTime = uint64_t{1} << 62;

/// Checks an operation from an untrusted source. Errors: invalid_argument or range if no edit log could have created
/// it.
Result<void> checkEdit(const EditOperation& operation);

/// Appends the encoded brush to `bytes`. Equal brushes give equal bytes, even if members that their shape does not use
/// differ.
void encodeBrush(const Brush& brush, std::vector<std::byte>& bytes);

/// Appends the encoded operation. Equal operations give equal bytes, even if members that their kind does not use
/// differ.
void encodeEdit(const EditOperation& operation, std::vector<std::byte>& bytes);
/// Decodes the next operation. Error: bad_input if the bytes end too early, or if no edit log could have created the
/// operation.
Result<EditOperation> decodeEdit(ByteReader& bytes);

inline constexpr size_t kLeastEditBytes = 41,
                        kMaxEditBytes = 75;  ///< minimum and maximum size of an encoded operation in bytes

}  // namespace sgm
