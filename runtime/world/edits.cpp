#include "world/edits.h"

#include <algorithm>
#include <string>

#include "base/checksum.h"
#include "base/hash.h"

namespace sgm {

namespace {

constexpr uint32_t kExportMagic = 0x454D4753, kExportVersion = 1;  // "SGME"
constexpr size_t kExportHead = 16, kChecksumBytes = 8;

std::string nameOf(EditId id) { return std::to_string(id.number) + " of author " + std::to_string(id.author); }

bool laysBrush(const EditOperation& operation) { return operation.kind == EditOperation::Kind::brush; }

std::vector<std::byte> bytesOf(const EditOperation& operation) {
  std::vector<std::byte> bytes;
  encodeEdit(operation, bytes);
  return bytes;
}

}  // namespace

EditLog::EditLog(EditSettings settings, std::pmr::memory_resource* memory)
    : settings_(settings), known_(memory), places_(memory), sights_(memory), shown_(memory) {}

const EditOperation* EditLog::find(EditId id) const {
  const auto at = places_.find(id);
  return at == places_.end() ? nullptr : &known_[at->second];
}

bool EditLog::hidden(EditId brush) const {
  const auto at = sights_.find(brush);
  return at != sights_.end() && at->second.hidden;
}

Result<void> EditLog::checkLabels(const Brush& brush) const {
  const auto beyond = [](const char* what, uint16_t has, uint16_t most) {
    return Error{Code::invalid_argument, "a brush's " + std::string(what) + " is " + std::to_string(has) +
                                             ", but the last one is " + std::to_string(most)};
  };
  if (brush.material > settings_.max_material) return beyond("material", brush.material, settings_.max_material);
  if (brush.tag > settings_.max_tag) return beyond("tag", brush.tag, settings_.max_tag);
  return {};
}

void EditLog::makeRoom(size_t more) {
  if (known_.capacity() - known_.size() < more) known_.reserve(std::max(known_.size() + more, 2 * known_.size()));
}

// Precondition: the checks for limits have passed. If memory runs out, the operation stays unknown and nothing changes.
IntBox EditLog::insert(const EditOperation& operation, uint64_t batch) {
  const EditId id = operation.order.id;
  const uint64_t own = checksum(bytesOf(operation));
  Observation* sight = laysBrush(operation) ? nullptr : &sights_[operation.target];
  const auto place = places_.emplace(id, known_.size()).first;
  IntBox changed;
  try {
    if (!sight) {
      if (!hidden(id)) {
        shown_ = shown_.with(operation.order, operation.brush, batch);
        changed = brushBounds(operation.brush);
      }
    } else if (sight->order < operation.order) {
      const bool hides = operation.kind == EditOperation::Kind::undo;
      const EditOperation* target = operation.target == id ? nullptr : find(operation.target);
      if (target && laysBrush(*target) && sight->hidden != hides) {
        shown_ = hides ? shown_.without(target->order, target->brush, batch)
                       : shown_.with(target->order, target->brush, batch);
        changed = brushBounds(target->brush);
      }
      *sight = {operation.order, hides};
    }
  } catch (...) {
    places_.erase(place);
    throw;
  }
  known_.push_back(operation);
  latest_ = std::max(latest_, operation.order.time);
  if (id.author == settings_.author) number_ = std::max(number_, id.number);
  sum_ += own;
  return changed;
}

Result<EditLog::Edited> EditLog::make(EditOperation operation) {
  if (known_.size() >= settings_.max_operations || number_ >= kMaxEditTime) {
    return Error{Code::limit,
                 "the world cannot hold more edits than the " + std::to_string(known_.size()) + " that it has"};
  }
  // The time of a received operation may already be kMaxEditTime. Then all later operations get that time, too, and
  // their ids order them.
  operation.order = {std::min(latest_ + 1, kMaxEditTime), {settings_.author, number_ + 1}};
  if (Result<void> good = checkEdit(operation); !good) return good.error();
  makeRoom(1);
  const IntBox box = insert(operation, 0);
  return Edited{operation.order.id, box};
}

Result<EditLog::Edited> EditLog::add(const Brush& brush) {
  if (Result<void> named = checkLabels(brush); !named) return named.error();
  EditOperation operation;
  operation.brush = brush;
  return make(operation);
}

Result<EditLog::Edited> EditLog::undo(EditId id) {
  const EditOperation* undone = find(id);
  const EditOperation* brush = undone && !laysBrush(*undone) ? find(undone->target) : undone;
  if (!brush || !laysBrush(*brush)) {
    return Error{Code::invalid_argument, "there is no edit " + nameOf(id) + " to undo"};
  }
  EditOperation operation;
  operation.kind = undone->kind == EditOperation::Kind::undo ? EditOperation::Kind::redo : EditOperation::Kind::undo;
  operation.target = brush->order.id;
  return make(operation);
}

Result<std::vector<IntBox>> EditLog::merge(std::span<const EditOperation> operations) {
  std::map<EditId, const EditOperation*> fresh;
  for (const EditOperation& operation : operations) {
    const EditId id = operation.order.id;
    if (Result<void> good = checkEdit(operation); !good) {
      return Error{Code::bad_input, "edit " + nameOf(id) + ": " + good.error().message};
    }
    const auto at = fresh.find(id);
    const EditOperation* known = at == fresh.end() ? find(id) : at->second;
    if (!known) {
      fresh.emplace(id, &operation);
    } else if (bytesOf(*known) != bytesOf(operation)) {
      return Error{Code::bad_input, "edit " + nameOf(id) + " already exists with other contents"};
    }
  }
  if (known_.size() + fresh.size() > settings_.max_operations) {
    return Error{Code::limit, "the world would have " + std::to_string(known_.size() + fresh.size()) +
                                  " edits, but it holds at most " + std::to_string(settings_.max_operations)};
  }
  // Inserts undos and redos before brushes, and later undos and redos before earlier ones. So each brush appears or
  // disappears at most once.
  std::vector<const EditOperation*> order;
  for (const auto& [id, operation] : fresh) order.push_back(operation);
  std::sort(order.begin(), order.end(), [](const EditOperation* a, const EditOperation* b) {
    return laysBrush(*a) != laysBrush(*b) ? laysBrush(*b) : a->order > b->order;
  });
  std::vector<IntBox> changed;
  makeRoom(fresh.size());
  ++batch_;
  for (const EditOperation* operation : order) {
    if (const IntBox box = insert(*operation, batch_); !box.empty()) changed.push_back(box);
  }
  return changed;
}

Result<std::vector<IntBox>> EditLog::import(std::span<const std::byte> bytes) {
  const auto bad = [](const char* why) {
    return Error{Code::bad_input, "these bytes are not exported edits: " + std::string(why)};
  };
  if (bytes.size() < kExportHead + kChecksumBytes) return bad("they are truncated");
  const auto content = bytes.first(bytes.size() - kChecksumBytes);
  ByteReader in(content), tail(bytes.last(kChecksumBytes));
  if (in.get<uint32_t>() != kExportMagic) return bad("their magic number differs");
  if (in.get<uint32_t>() != kExportVersion) return bad("they have another version");
  if (tail.get<uint64_t>() != checksum(content)) return bad("their checksum differs");
  const auto count = in.get<uint64_t>();
  // The count is checked before memory is allocated for it.
  if (count > in.left() / kLeastEditBytes) return bad("they are truncated");
  std::vector<EditOperation> operations;
  operations.reserve(static_cast<size_t>(count));
  for (uint64_t i = 0; i < count; ++i) {
    Result<EditOperation> operation = decodeEdit(in);
    if (!operation) return operation.error();
    operations.push_back(*operation);
  }
  if (in.left() > 0) return bad("there are bytes after the last edit");
  return merge(operations);
}

std::span<const EditOperation> EditLog::operations(uint64_t since) const {
  return std::span(known_).subspan(static_cast<size_t>(std::min<uint64_t>(since, known_.size())));
}

std::vector<std::byte> EditLog::exportBytes(uint64_t since) const {
  const std::span<const EditOperation> list = operations(since);
  std::vector<std::byte> bytes;
  bytes.reserve(kExportHead + list.size() * kMaxEditBytes + kChecksumBytes);
  ByteWriter out(bytes);
  out.put(kExportMagic);
  out.put(kExportVersion);
  out.put(static_cast<uint64_t>(list.size()));
  for (const EditOperation& operation : list) encodeEdit(operation, bytes);
  out.put(checksum(bytes));
  return bytes;
}

uint64_t EditLog::hash() const { return hashCombine(known_.size(), sum_); }

std::shared_ptr<const EditSnapshot> EditLog::snapshot() const { return std::make_shared<const EditSnapshot>(shown_); }

IntBox editReach(const IntBox& changed, int32_t cell) { return changed.grown(influenceMargin(2 * cell)); }

std::vector<EditOperation> essentialEdits(std::span<const EditOperation> operations) {
  std::map<EditId, const EditOperation*> sights;
  std::map<uint64_t, uint64_t> last;  // the last operation number of each author
  for (const EditOperation& operation : operations) {
    const EditId id = operation.order.id;
    last[id.author] = std::max(last[id.author], id.number);
    if (laysBrush(operation)) continue;
    const EditOperation*& latest = sights[operation.target];
    if (!latest || latest->order < operation.order) latest = &operation;
  }
  std::vector<EditOperation> kept;
  for (const EditOperation& operation : operations) {
    const EditId id = operation.order.id;
    const auto at = sights.find(laysBrush(operation) ? id : operation.target);
    const EditOperation* latest = at == sights.end() ? nullptr : at->second;
    const bool shows = !latest || latest->kind == EditOperation::Kind::redo;
    if ((laysBrush(operation) ? shows : latest == &operation) || last[id.author] == id.number)
      kept.push_back(operation);
  }
  return kept;
}

}  // namespace sgm
