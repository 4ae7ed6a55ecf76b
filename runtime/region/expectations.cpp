#include "region/expectations.h"

#include <algorithm>
#include <limits>

#include "grammar/text/sink.h"
#include "region/region.h"

namespace sgm {
namespace {

bool compare(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::less:
      return a < b;
    case BinaryOp::less_equal:
      return a <= b;
    case BinaryOp::greater:
      return a > b;
    case BinaryOp::greater_equal:
      return a >= b;
    case BinaryOp::not_equal:
      return a != b;
    default:
      return a == b;
  }
}

bool holdsFor(const Expectation& e, const Measured& measured) {
  if (!e.expect) return true;
  if (!measured.value) return false;
  const double value = *measured.value;
  if (e.measure == Measure::watertight) return value != 0;
  if (e.compared && !compare(e.comparison, value, e.value_number)) return false;
  return e.low == kNoId || (value >= e.low_number && value <= e.high_number);
}

WantedMeasures wantedFor(const Program& program, std::span<const uint32_t> statements) {
  WantedMeasures wanted;
  for (uint32_t s : statements) {
    const Measure measure = program.expectations[s].measure;
    wanted.topology |= measure == Measure::watertight || measure == Measure::genus;
    wanted.components |= measure == Measure::components;
    wanted.volume |= measure == Measure::volume;
  }
  return wanted;
}

/// Converts a piece from samples to units: its size becomes a volume in m3, and its box contains the cubes around its
/// samples.
MeasuredPiece placed(const Piece& piece, const RegionMeasures& region) {
  MeasuredPiece out;
  out.volume = static_cast<double>(piece.samples) * region.sample;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t first = int64_t{region.extent.lo[axis]} - region.cell / 2;
    out.box.lo[axis] = saturate(first + int64_t{piece.box.lo[axis]} * region.cell);
    out.box.hi[axis] = saturate(first + (int64_t{piece.box.hi[axis]} + 1) * region.cell);
  }
  return out;
}

/// Extracts the measure that a statement names from the measures of a region. Does not support the measure `anchors`.
Measured read(const Program& program, const Expectation& e, const RegionMeasures& region) {
  Measured result;
  switch (e.measure) {
    case Measure::watertight:
      result.value = region.topology.watertight ? 1 : 0;
      result.why = region.topology.leak;
      break;
    case Measure::components: {
      if (e.above != kNoId && e.above_number < region.sample) {
        result.why = "one sample stands for " + numberText(region.sample) +
                     " m3, more than the volume in question: measure with smaller cells";
        break;
      }
      const std::span<const Piece> found = largerThan(
          program.text(e.of) == "air" ? region.pieces.air : region.pieces.solid, e.above_number / region.sample);
      result.value = static_cast<double>(found.size());
      for (const Piece& piece : found.first(std::min(found.size(), kMaxPieces)))
        result.pieces.push_back(placed(piece, region));
      break;
    }
    case Measure::volume:
      result.value = region.volume;
      result.cubes = region.cubes;
      break;
    case Measure::area:
      result.value = region.area;
      break;
    case Measure::triangles:
      result.value = static_cast<double>(region.triangles);
      break;
    case Measure::genus:
      if (region.topology.genus) result.value = static_cast<double>(*region.topology.genus);
      result.why = region.topology.why;
      break;
    case Measure::anchors:
      break;
  }
  return result;
}

/// True if an error ends the whole evaluation. Other errors become the outcome of one statement.
bool isFatal(const Error& error) { return error.code == Code::out_of_memory || error.code == Code::cancelled; }

class Evaluator {
 public:
  Evaluator(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs, std::pmr::memory_resource* memory,
            const Progress& progress)
      : settings_(settings),
        program_(*settings.program),
        backend_(backend),
        jobs_(jobs),
        memory_(memory),
        progress_(progress) {
    result_.outcomes.resize(program_.expectations.size());
  }

  Result<Evaluation> run() {
    for (const std::vector<uint32_t>& statements : together()) {
      const Expectation& first = program_.expectations[statements[0]];
      const Result<void> done = first.per == kNoId ? whole(statements) : each(statements, first.per);
      if (done) continue;
      if (isFatal(done.error())) return done.error();
      for (uint32_t s : statements) result_.outcomes[s].error = done.error();
    }
    return std::move(result_);
  }

 private:
  /// Groups the statements that have the same rule (or none) and the same region; each group can share measurements.
  /// Groups are in the order of their first statements. Also sets the region of each statement's outcome.
  std::vector<std::vector<uint32_t>> together() {
    std::vector<std::vector<uint32_t>> sets;
    for (uint32_t s = 0; s < program_.expectations.size(); ++s) {
      const Expectation& e = program_.expectations[s];
      const Result<IntBox> region = regionOf(program_, e, settings_.region);
      if (!region) {
        result_.outcomes[s].error = region.error();
        continue;
      }
      result_.outcomes[s].region = *region;
      const auto same = std::find_if(sets.begin(), sets.end(), [&](const std::vector<uint32_t>& set) {
        return program_.expectations[set[0]].per == e.per && result_.outcomes[set[0]].region == *region;
      });
      if (same == sets.end()) {
        sets.push_back({s});
      } else {
        same->push_back(s);
      }
    }
    return sets;
  }

  WorldFieldSettings worldSettings(int32_t cell) const {
    WorldFieldSettings s;
    s.program = settings_.program;
    s.parameters = settings_.parameters;
    s.seed = settings_.seed;
    s.finest_cell = cell;
    s.cache_bytes = settings_.cache_bytes;
    return s;
  }

  Result<int32_t> cellOf(std::span<const IntBox> boxes) const {
    if (settings_.cell == 0) return cellFor(boxes, settings_.max_chunks);
    uint64_t chunks = 0;
    for (const IntBox& box : boxes) {
      chunks += countChunks(box, settings_.cell);
      if (chunks > settings_.max_chunks) {
        return Error{Code::limit, "this takes more than " + std::to_string(settings_.max_chunks) +
                                      " chunks; make the cells larger" +
                                      fittingCellText(boxes, 0, settings_.cell, settings_.max_chunks) +
                                      " or the region smaller, or raise the limit"};
      }
    }
    return settings_.cell;
  }

  void keep(uint32_t statement, Measured measured) {
    measured.holds = holdsFor(program_.expectations[statement], measured);
    result_.outcomes[statement].measured.push_back(std::move(measured));
  }

  Result<void> whole(std::span<const uint32_t> statements) {
    const IntBox region = result_.outcomes[statements[0]].region;
    const Result<int32_t> cell = cellOf({&region, 1});
    if (!cell) return cell.error();
    const WorldField world(worldSettings(*cell), memory_);
    const Result<RegionMeasures> measures =
        measureRegion(world, backend_, jobs_, region, settings_.max_chunks, wantedFor(program_, statements), progress_);
    if (!measures) return measures.error();
    for (uint32_t s : statements) {
      Outcome& outcome = result_.outcomes[s];
      outcome.region = measures->extent;
      outcome.cell = *cell;
      outcome.chunks = measures->chunks;
      Measured measured = read(program_, program_.expectations[s], *measures);
      if (program_.expectations[s].measure == Measure::anchors) {
        const Result<std::vector<Anchor>> anchors = world.anchors(measures->extent);
        if (!anchors) return anchors.error();
        measured.value = static_cast<double>(anchors->size());
      }
      keep(s, std::move(measured));
    }
    // Code::limit means that the region meets too many cells of a layer to visit all of them. Then there are no notes,
    // which is not an error.
    const Result<std::vector<DeriveNote>> notes = world.notes(measures->extent, *cell);
    if (!notes && notes.error().code != Code::limit) return notes.error();
    if (notes) result_.notes.insert(result_.notes.end(), notes->begin(), notes->end());
    return {};
  }

  Result<void> each(std::span<const uint32_t> statements, uint32_t rule) {
    const WorldField derived(worldSettings(kMeasuredCell), memory_);
    Result<std::vector<RuleInstance>> instances =
        derived.instances(rule, result_.outcomes[statements[0]].region, settings_.max_chunks);
    if (!instances) return instances.error();
    std::vector<IntBox> boxes;
    for (const RuleInstance& instance : *instances) boxes.push_back(boxOf(instance));
    std::vector<IntBox> meshed = boxes;
    std::erase_if(meshed, [](const IntBox& box) { return box.empty(); });
    const Result<int32_t> cell = cellOf(meshed);
    if (!cell) return cell.error();
    for (uint32_t s : statements) result_.outcomes[s].cell = *cell;
    const WantedMeasures wanted = wantedFor(program_, statements);
    for (size_t i = 0; i < instances->size(); ++i) {
      RuleInstance& instance = (*instances)[i];
      const size_t anchors = instance.chunk.anchors.size();
      RegionMeasures measures = nothing();
      if (!boxes[i].empty()) {
        const WorldField world(worldSettings(*cell),
                               std::make_shared<const DerivedCell>(std::move(instance.chunk), memory_), memory_);
        Result<RegionMeasures> made =
            measureRegion(world, backend_, jobs_, boxes[i], settings_.max_chunks, wanted, progress_);
        if (!made) return made.error();
        measures = std::move(*made);
      }
      for (uint32_t s : statements) {
        Measured measured = read(program_, program_.expectations[s], measures);
        if (!instance.bounded) measured = {std::nullopt, "one of its shapes is unbounded", {}, {}, true, {}, {}};
        if (program_.expectations[s].measure == Measure::anchors) measured.value = static_cast<double>(anchors);
        measured.path = instance.path;
        measured.origin = instance.origin;
        result_.outcomes[s].chunks += measures.chunks;
        keep(s, std::move(measured));
      }
    }
    return {};
  }

  /// Returns a box around all shapes of a rule's use, with void on every side; empty if there is no shape.
  static IntBox boxOf(const RuleInstance& instance) {
    IntBox box;
    for (const Group& group : instance.chunk.groups) {
      if (!group.cut) box = box.joined(group.bounds);
    }
    if (box.empty()) return box;
    box = box.grown(1);
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = saturate(int64_t{box.hi[axis]} + 1);
    return box;
  }

  /// Returns the measures of a rule's use that has no shapes.
  static RegionMeasures nothing() {
    RegionMeasures measures;
    measures.topology.watertight = true;
    measures.topology.genus = 0;
    measures.pieces.air = {{std::numeric_limits<uint64_t>::max(), {}}};
    measures.sample = 1;
    return measures;
  }

  const ExpectationSettings& settings_;
  const Program& program_;
  Backend& backend_;
  JobSystem& jobs_;
  std::pmr::memory_resource* memory_;
  const Progress& progress_;
  Evaluation result_;
};

}  // namespace

bool Outcome::holds() const {
  return !error && std::all_of(measured.begin(), measured.end(), [](const Measured& m) { return m.holds; });
}

Result<Evaluation> evaluateExpectations(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs,
                                        std::pmr::memory_resource* memory, const Progress& progress) {
  return Evaluator(settings, backend, jobs, memory, progress).run();
}

}  // namespace sgm
