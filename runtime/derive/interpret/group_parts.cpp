#include "derive/interpret/group_parts.h"

#include <algorithm>
#include <limits>

#include "derive/bounds.h"
#include "derive/coarse_chunk.h"

namespace sgm {
namespace {

class PartSearch {
 public:
  PartSearch(const GrammarChunk& group, const IntBox& limit, const std::function<bool(uint64_t)>& step)
      : group_(group), limit_(limit), step_(step), root_(group.groups[0].root), gone_(group.shapes.size(), false) {
    levels_.push_back(std::numeric_limits<int32_t>::max());
    for (const Shape& s : group.shapes) levels_.push_back(coarsestOf(group, s));
    std::sort(levels_.begin(), levels_.end(), std::greater<>());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  }

  std::optional<GroupParts> run() {
    for (size_t next = 0;; ++next) {
      next = firstBeyond(next);
      if (refused_) return std::nullopt;
      if (next == levels_.size()) break;
      if (!takeOut(next)) return GroupParts{};
      if (refused_) return std::nullopt;
    }
    out_.any = true;
    out_.bounds = bounds(shown(levels_.size() - 1));
    return std::move(out_);
  }

 private:
  /// The group without the shapes that are invisible at one level, and a flag for each shape: true if it is visible.
  struct Shown {
    GrammarChunk chunk;
    std::vector<bool> shows;
  };

  Shown shown(size_t level) {
    refused_ = refused_ || !step_(group_.shapes.size() + group_.exprs.size());
    Shown out{group_, {}};
    out.shows = hideShapes(out.chunk, levels_[level], gone_);
    return out;
  }

  IntBox bounds(const Shown& at) const { return at.shows[root_] ? levelBounds(at.chunk, root_, 0) : IntBox{}; }

  /// Returns the index in levels_ of the coarsest level, not before `from`, at which the group exceeds the limit. The
  /// search is a bisection: finer levels show more, so the group exceeds the limit at all finer levels, too.
  size_t firstBeyond(size_t from) {
    size_t end = levels_.size();
    while (from < end && !refused_) {
      const size_t middle = from + (end - from) / 2;
      if (isWithin(bounds(shown(middle)), limit_))
        from = middle + 1;
      else
        end = middle;
    }
    return end;
  }

  /// Removes parts that become visible at this level (an index in levels_): first the parts that exceed the limit by
  /// themselves, then, if the group still exceeds it, all parts that become visible here. Returns false if the whole
  /// group first becomes visible at this level.
  bool takeOut(size_t level) {
    if (level == 0) return false;
    const std::vector<bool> sooner = shown(level - 1).shows;
    if (!sooner[root_]) return false;
    const Shown now = shown(level);
    const ShapeBounds each(now.chunk);
    std::vector<LeftOutPart> parts;
    for (uint32_t i = 0; i < group_.shapes.size(); ++i) {
      const Shape& s = group_.shapes[i];
      for (uint32_t k = 0; sooner[i] && k < s.child_count; ++k) {
        const uint32_t part = group_.children[s.first_child + k];
        if (isFreePart(s.kind, k) && now.shows[part] && !sooner[part]) parts.push_back({part, each.level(part, 0)});
      }
    }
    const auto beyond = std::stable_partition(parts.begin(), parts.end(),
                                              [&](const LeftOutPart& part) { return !isWithin(part.bounds, limit_); });
    for (auto part = parts.begin(); part != beyond; ++part) gone_[part->shape] = true;
    const IntBox rest = bounds(shown(level));
    if (isWithin(rest, limit_)) {
      parts.erase(beyond, parts.end());
    } else {
      for (auto part = beyond; part != parts.end(); ++part) {
        gone_[part->shape] = true;
        part->bounds = rest;
      }
    }
    out_.left_out.insert(out_.left_out.end(), parts.begin(), parts.end());
    return true;
  }

  const GrammarChunk& group_;
  const IntBox& limit_;
  const std::function<bool(uint64_t)>& step_;
  const uint32_t root_;
  std::vector<int32_t> levels_;  ///< cell edges at which further parts become visible, from coarse to fine
  std::vector<bool> gone_;
  bool refused_ = false;
  GroupParts out_;
};

}  // namespace

std::optional<GroupParts> partsWithin(const GrammarChunk& group, const IntBox& limit,
                                      const std::function<bool(uint64_t)>& step) {
  return PartSearch(group, limit, step).run();
}

bool isWithin(const IntBox& bounds, const IntBox& limit) {
  return bounds.empty() || (isBounded(bounds) && limit.contains(bounds));
}

}  // namespace sgm
