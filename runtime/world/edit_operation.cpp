#include "world/edit_operation.h"

#include <string>

namespace sgm {

namespace {

void put(ByteWriter& out, EditId id) {
  out.put(id.author);
  out.put(id.number);
}
EditId getId(ByteReader& in) {
  const auto author = in.get<uint64_t>();
  return {author, in.get<uint64_t>()};
}

void put(ByteWriter& out, Int3 p) {
  for (int axis = 0; axis < 3; ++axis) out.put(p[axis]);
}
Int3 getPlace(ByteReader& in) {
  Int3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = in.get<int32_t>();
  return p;
}

// Decodes a brush. Returns false if a byte is not a valid value.
bool get(ByteReader& in, Brush& brush) {
  const auto shape = in.get<uint8_t>(), cut = in.get<uint8_t>();
  if (shape > static_cast<uint8_t>(Brush::Shape::capsule) || cut > 1) return false;
  brush.shape = static_cast<Brush::Shape>(shape);
  brush.cut = cut != 0;
  brush.material = in.get<uint16_t>();
  brush.tag = in.get<uint16_t>();
  brush.smooth = in.get<int32_t>();
  brush.from = getPlace(in);
  if (brush.shape == Brush::Shape::box) {
    brush.half = getPlace(in);
    for (float& q : brush.turn) q = in.get<float>();
    return true;
  }
  brush.radius = in.get<int32_t>();
  if (brush.shape == Brush::Shape::capsule) brush.to = getPlace(in);
  return true;
}

}  // namespace

void encodeBrush(const Brush& brush, std::vector<std::byte>& bytes) {
  ByteWriter out(bytes);
  out.put(static_cast<uint8_t>(brush.shape));
  out.put(static_cast<uint8_t>(brush.cut));
  out.put(brush.material);
  out.put(brush.tag);
  out.put(brush.smooth);
  put(out, brush.from);
  if (brush.shape == Brush::Shape::box) {
    put(out, brush.half);
    for (float q : brush.turn) out.put(q);
    return;
  }
  out.put(brush.radius);
  if (brush.shape == Brush::Shape::capsule) put(out, brush.to);
}

void encodeEdit(const EditOperation& operation, std::vector<std::byte>& bytes) {
  ByteWriter out(bytes);
  out.put(static_cast<uint8_t>(operation.kind));
  put(out, operation.order.id);
  out.put(operation.order.time);
  if (operation.kind == EditOperation::Kind::brush) {
    encodeBrush(operation.brush, bytes);
  } else {
    put(out, operation.target);
  }
}

Result<void> checkEdit(const EditOperation& operation) {
  for (const uint64_t n : {operation.order.time, operation.order.id.number}) {
    if (n >= 1 && n <= kMaxEditTime) continue;
    return Error{Code::invalid_argument,
                 "an edit's time or number is " + std::to_string(n) + ", which is out of range"};
  }
  return operation.kind == EditOperation::Kind::brush ? checkBrush(operation.brush) : Result<void>();
}

Result<EditOperation> decodeEdit(ByteReader& bytes) {
  const auto bad = [](const std::string& why) { return Error{Code::bad_input, "an edit's bytes are damaged: " + why}; };
  EditOperation operation;
  const auto kind = bytes.get<uint8_t>();
  operation.order.id = getId(bytes);
  operation.order.time = bytes.get<uint64_t>();
  bool known = kind <= static_cast<uint8_t>(EditOperation::Kind::redo);
  operation.kind = known ? static_cast<EditOperation::Kind>(kind) : EditOperation::Kind::undo;
  if (operation.kind == EditOperation::Kind::brush) {
    known = get(bytes, operation.brush);
  } else {
    operation.target = getId(bytes);
  }
  if (bytes.failed()) return bad("they are truncated");
  if (!known) return bad("a number is out of range");
  if (Result<void> could = checkEdit(operation); !could) return bad(could.error().message);
  return operation;
}

}  // namespace sgm
