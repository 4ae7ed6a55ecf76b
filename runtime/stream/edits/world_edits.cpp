#include "stream/edits/world_edits.h"

#include <algorithm>

namespace sgm {

namespace {

/// Maximum number of unread changes. If there are more, they are merged: without viewers a world reads no changes, but
/// may be edited endlessly.
constexpr size_t kMaxChanges = 4096;

}  // namespace

WorldEdits::WorldEdits(std::shared_ptr<const WorldField> field, const EditSettings& settings,
                       std::pmr::memory_resource* memory)
    : log_(settings, memory), field_(std::move(field)) {}

Result<std::string> WorldEdits::open(const std::filesystem::path& path, const WorldIdentity& world,
                                     const FormerGrammar& former) {
  Result<OpenedJournal> opened = EditJournal::open(path, world, former);
  if (!opened) return opened.error();
  const std::lock_guard lock(mutex_);
  const Result<void> merged = merge([&] { return log_.merge(opened->operations); });
  if (!merged) {
    return Error{merged.error().code,
                 "the journal " + path.string() + " does not fit this world: " + merged.error().message};
  }
  journal_ = std::move(opened->journal);
  journalled_ = log_.size();
  return std::move(opened->message);
}

// Reserves memory for `more` changes before an edit is made, so that recording them cannot fail afterwards.
void WorldEdits::makeRoom(size_t more) {
  if (changes_.size() + more > kMaxChanges) {
    WorldChange all;
    for (const WorldChange& change : changes_) {
      if (change.field == nullptr) all = {change.number, all.box.joined(change.box), nullptr};
    }
    std::erase_if(changes_, [](const WorldChange& change) { return change.field == nullptr; });
    changes_.push_back(all);
  }
  changes_.reserve(changes_.size() + more);
}

void WorldEdits::changed(std::span<const IntBox> boxes) {
  unwritten_.store(journal_ != nullptr, std::memory_order_release);
  const uint64_t number = number_.load(std::memory_order_relaxed) + 1;
  for (const IntBox& box : boxes) {
    if (box.empty()) continue;
    changes_.push_back({number, box, nullptr});
    number_.store(number, std::memory_order_release);
  }
}

template <class Merge>
Result<void> WorldEdits::merge(const Merge& from) {
  const IntBox everything = IntBox::everything();
  makeRoom(1);
  try {
    const Result<std::vector<IntBox>> boxes = from();
    if (!boxes) return boxes.error();
    if (boxes->size() > kMaxChanges) {
      IntBox all;
      for (const IntBox& box : *boxes) all = all.joined(box);
      changed({&all, 1});
    } else {
      makeRoom(boxes->size());
      changed(*boxes);
    }
  } catch (const std::bad_alloc&) {
    // Memory ran out after an unknown part of the operations was merged, so the whole world counts as changed.
    changed({&everything, 1});
    throw;
  }
  return {};
}

Result<EditId> WorldEdits::add(const Brush& brush) {
  const std::lock_guard lock(mutex_);
  makeRoom(1);
  const Result<EditLog::Edited> edited = log_.add(brush);
  if (!edited) return edited.error();
  changed({&edited->box, 1});
  return edited->id;
}

Result<EditId> WorldEdits::undo(EditId id) {
  const std::lock_guard lock(mutex_);
  makeRoom(1);
  const Result<EditLog::Edited> edited = log_.undo(id);
  if (!edited) return edited.error();
  changed({&edited->box, 1});
  return edited->id;
}

Result<void> WorldEdits::import(std::span<const std::byte> bytes) {
  const std::lock_guard lock(mutex_);
  return merge([&] { return log_.import(bytes); });
}

std::vector<std::byte> WorldEdits::exportBytes(uint64_t since) const {
  const std::lock_guard lock(mutex_);
  return log_.exportBytes(since);
}

uint64_t WorldEdits::size() const {
  const std::lock_guard lock(mutex_);
  return log_.size();
}

uint64_t WorldEdits::hash() const {
  const std::lock_guard lock(mutex_);
  return log_.hash();
}

WorldState WorldEdits::state() const {
  const std::lock_guard lock(mutex_);
  const uint64_t now = number();
  return {now, field_, now != 0 ? log_.snapshot() : nullptr};
}

uint64_t WorldEdits::setField(std::shared_ptr<const FieldChange> change) {
  const std::lock_guard lock(mutex_);
  makeRoom(1);
  const uint64_t number = number_.load(std::memory_order_relaxed) + 1;
  field_ = change->to();
  const Program& program = *field_->settings().program;
  log_.setLabels(static_cast<uint16_t>(program.materials.size() - 1), static_cast<uint16_t>(program.tags.size() - 1));
  changes_.push_back({number, {}, std::move(change)});
  number_.store(number, std::memory_order_release);
  return number;
}

std::vector<WorldChange> WorldEdits::changedSince(uint64_t number) const {
  const std::lock_guard lock(mutex_);
  std::vector<WorldChange> since;
  std::copy_if(changes_.begin(), changes_.end(), std::back_inserter(since),
               [number](const WorldChange& change) { return change.number > number; });
  return since;
}

void WorldEdits::forget(uint64_t number) {
  std::vector<WorldChange> forgotten;  // declared before the lock, so that its large content is destroyed after the
                                       // mutex is released
  const std::lock_guard lock(mutex_);
  const auto kept = std::stable_partition(changes_.begin(), changes_.end(),
                                          [number](const WorldChange& change) { return change.number <= number; });
  if (kept == changes_.begin()) return;
  std::vector<WorldChange> left(std::make_move_iterator(kept), std::make_move_iterator(changes_.end()));
  changes_.erase(kept, changes_.end());
  forgotten.swap(changes_);
  changes_.swap(left);
}

Result<void> WorldEdits::flush() {
  if (journal_ == nullptr) return {};
  try {
    {
      const std::lock_guard lock(mutex_);
      unwritten_.store(false, std::memory_order_release);
      journal_->append(log_.operations(journalled_));
      journalled_ = log_.size();
    }
    Result<void> flushed = journal_->flush();
    if (!flushed) unwritten_.store(true, std::memory_order_release);
    return flushed;
  } catch (const std::bad_alloc&) {
    unwritten_.store(true, std::memory_order_release);
    throw;
  }
}

}  // namespace sgm
