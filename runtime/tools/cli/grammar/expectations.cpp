#include "tools/cli/grammar/expectations.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "grammar/print/printer.h"
#include "region/expectations.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

std::string metresText(Int3 p) { return fmt::format("{},{},{}", metres(p.x), metres(p.y), metres(p.z)); }

const char* unitOf(Measure measure) {
  return measure == Measure::volume ? " m3" : measure == Measure::area ? " m2" : "";
}

std::string numberText(Measure measure, double value) {
  if (measure == Measure::watertight) return value != 0 ? "yes" : "no";
  if (measure != Measure::volume && measure != Measure::area) return fmt::format("{:.0f}", value);
  return std::fabs(value) < 100 ? fmt::format("{:.4g}", value) : fmt::format("{:.1f}", value);
}

std::string valueText(Measure measure, const Measured& measured) {
  if (!measured.value) return "not measured: " + measured.why;
  const std::string text = numberText(measure, *measured.value) + unitOf(measure);
  return measured.why.empty() ? text : text + ": " + measured.why;
}

struct MeasuredSpread {
  size_t count = 0;  ///< number of measured values
  double least = 0, mean = 0, most = 0;
};

MeasuredSpread measuredSpread(const std::vector<Measured>& measured) {
  MeasuredSpread spread;
  double sum = 0;
  for (const Measured& m : measured) {
    if (!m.value) continue;
    spread.least = spread.count == 0 ? *m.value : std::min(spread.least, *m.value);
    spread.most = spread.count == 0 ? *m.value : std::max(spread.most, *m.value);
    sum += *m.value;
    ++spread.count;
  }
  if (spread.count > 0) spread.mean = sum / static_cast<double>(spread.count);
  return spread;
}

std::string spreadText(Measure measure, const std::vector<Measured>& measured) {
  const MeasuredSpread spread = measuredSpread(measured);
  std::string text = measured.size() == 1 ? "1 use" : fmt::format("{} uses", measured.size());
  if (spread.count < measured.size()) text += fmt::format(", {} not measured", measured.size() - spread.count);
  if (spread.count == 0) return text;
  if (measure == Measure::watertight) return text + fmt::format(", {:.0f}% of them", 100 * spread.mean);
  const double mean = spread.mean;
  const bool whole = measure != Measure::volume && measure != Measure::area;
  return text + fmt::format(", minimum {}, mean {}, maximum {}{}", numberText(measure, spread.least),
                            whole ? fmt::format("{:.4g}", mean) : numberText(measure, mean),
                            numberText(measure, spread.most), unitOf(measure));
}

/// The outcome of one `report` or `expect` statement with one seed, and texts that describe it.
struct Said {
  const Program& program;
  const Expectation& statement;
  const Outcome& outcome;
  uint64_t seed;

  bool per() const { return statement.per != kNoId; }
  const std::string file() const { return program.modules[statement.span.file].path.c_str(); }
  std::string measure() const { return printMeasure(program, statement); }
  std::string place() const { return fmt::format("{}:{}:{}", file(), statement.span.line, statement.span.column); }
  std::string where() const {
    std::string text = fmt::format("{} to {} m, ", metresText(outcome.region.lo), metresText(outcome.region.hi));
    if (outcome.cell > 0) text += fmt::format("cells of {} m, ", metres(outcome.cell));
    return text + fmt::format("seed {}", seed);
  }
};

/// Describes the pieces that a measure counts: "the smallest are 0.25 m3 in 1,2,3 to 2,3,4 m; ...". nullopt if there
/// are none.
std::optional<std::string> piecesText(const Measured& measured) {
  constexpr size_t kMaxNamed = 4;
  const std::vector<MeasuredPiece>& pieces = measured.pieces;
  if (pieces.empty()) return std::nullopt;
  std::string text = *measured.value == 1 ? "it is" : "the smallest are";
  for (size_t i = 0; i < std::min(pieces.size(), kMaxNamed); ++i)
    text += fmt::format("{} {:.4g} m3 in {} to {} m", i > 0 ? ";" : "", pieces[i].volume, metresText(pieces[i].box.lo),
                        metresText(pieces[i].box.hi));
  return text;
}

void print(const Said& said) {
  const Measure measure = said.statement.measure;
  const std::vector<Measured>& measured = said.outcome.measured;
  const std::string value = said.per() ? spreadText(measure, measured) : valueText(measure, measured[0]);
  if (said.statement.expect) {
    fmt::print("{}: expect: {}: holds ({}; {})\n", said.place(), said.measure(), value, said.where());
  } else {
    fmt::print("{}: report: {} = {} ({})\n", said.place(), said.measure(), value, said.where());
  }
}

Diagnostic diagnosticOf(const Said& said) {
  const Span& span = said.statement.span;
  Diagnostic d;
  d.code = "expectation";
  d.file = said.file();
  d.line = span.line;
  d.column = span.column;
  d.end_column = span.end_line == span.line ? span.end_column : span.column + 1;
  const std::string measure = said.measure();
  if (said.outcome.error) {
    const Error& error = *said.outcome.error;
    d.message = fmt::format("`{}` cannot be evaluated: {}", measure, error.message);
    if (error.line > 0) d.notes.push_back(fmt::format("at line {}, column {}", error.line, error.column));
    // The region is empty if the evaluation failed before the region was known.
    if (!said.outcome.region.empty()) d.notes.push_back(said.where());
    return d;
  }
  const std::vector<Measured>& all = said.outcome.measured;
  const auto failed = [](const Measured& m) { return !m.holds; };
  const Measured& first = *std::find_if(all.begin(), all.end(), failed);
  d.message = fmt::format("expected {}, but it is {}", measure, valueText(said.statement.measure, first));
  if (said.per()) {
    d.message += fmt::format(" in {} at {} m", first.path, metresText(first.origin));
    d.notes.push_back(fmt::format("{} of {}", std::count_if(all.begin(), all.end(), failed),
                                  spreadText(said.statement.measure, all)));
  }
  if (const std::optional<std::string> pieces = piecesText(first)) d.notes.push_back(*pieces);
  d.notes.push_back(said.where());
  return d;
}

Json piecesJson(const Measured& m) {
  Json json = Json::array();
  for (const MeasuredPiece& piece : m.pieces)
    json.push_back({{"volume", piece.volume}, {"box", {metresJson(piece.box.lo), metresJson(piece.box.hi)}}});
  return json;
}

Json valueJson(Measure measure, const Measured& m) {
  if (!m.value) return nullptr;
  if (measure == Measure::watertight) return *m.value != 0;
  if (measure == Measure::volume || measure == Measure::area) return *m.value;
  return static_cast<uint64_t>(*m.value);
}

Json toJson(const Said& said) {
  const Expectation& e = said.statement;
  const Outcome& outcome = said.outcome;
  Json json{{"file", said.file()},
            {"line", e.span.line},
            {"column", e.span.column},
            {"text", fmt::format("{} {};", e.expect ? "expect" : "report", said.measure())},
            {"measure", measureName(e.measure)},
            {"region", {metresJson(outcome.region.lo), metresJson(outcome.region.hi)}},
            {"cell", outcome.cell > 0 ? Json(metres(outcome.cell)) : Json()},
            {"chunks", outcome.chunks},
            {"seed", said.seed}};
  if (e.of != kNoId) json["of"] = said.program.text(e.of);
  if (outcome.error) {
    json["error"] = outcome.error->message;
  } else if (!said.per()) {
    json["value"] = valueJson(e.measure, outcome.measured[0]);
    if (!outcome.measured[0].why.empty()) json["reason"] = outcome.measured[0].why;
    if (outcome.measured[0].cubes) json["cubes"] = *outcome.measured[0].cubes;
    if (e.measure == Measure::components) json["pieces"] = piecesJson(outcome.measured[0]);
  } else {
    const MeasuredSpread spread = measuredSpread(outcome.measured);
    json["rule"] = said.program.text(e.per_name);
    json["count"] = outcome.measured.size();
    if (spread.count > 0) json.update({{"minimum", spread.least}, {"mean", spread.mean}, {"maximum", spread.most}});
    json["values"] = Json::array();
    for (const Measured& m : outcome.measured) {
      Json use{{"path", m.path}, {"at", metresJson(m.origin)}, {"value", valueJson(e.measure, m)}};
      if (!m.why.empty()) use["reason"] = m.why;
      if (m.cubes) use["cubes"] = *m.cubes;
      if (e.expect) use["holds"] = m.holds;
      if (e.measure == Measure::components) use["pieces"] = piecesJson(m);
      json["values"].push_back(std::move(use));
    }
  }
  json["holds"] = e.expect ? Json(outcome.holds()) : Json();
  return json;
}

}  // namespace

ExpectationSummary sayExpectations(const CompileResult& compiled, const WorldOptions& options, uint64_t seeds,
                                   Backend& backend, JobSystem& jobs) {
  ExpectationSummary summary;
  summary.statements = Json::array();
  const auto stop = [&](const Error& error) {
    summary.status = reportError(error);
    return summary;
  };
  const Program& program = *compiled.program;
  for (const Expectation& e : program.expectations) summary.expectations += e.expect;
  ExpectationSettings settings;
  settings.program = compiled.program;
  settings.max_chunks = options.max_chunks;
  settings.cache_bytes = kCacheBytes;
  Result<ParameterValues> parameters = parameterValues(program, options.sets);
  if (!parameters) return stop(parameters.error());
  settings.parameters = std::move(*parameters);
  if (!options.region.empty()) {
    const Result<IntBox> region = parseRegion(options.region);
    if (!region) return stop(region.error());
    settings.region = *region;
  }
  if (options.cell || options.density) {
    const Result<int32_t> cell = cellUnits(options);
    if (!cell) return stop(cell.error());
    settings.cell = *cell;
  }

  for (uint64_t i = 0; i < seeds; ++i) {
    settings.seed = options.seed + i;
    const Result<Evaluation> made = [&] {
      ProgressBar bar("measuring");
      return evaluateExpectations(settings, backend, jobs, std::pmr::new_delete_resource(),
                                  [&bar](uint64_t done, uint64_t total) {
                                    bar.show(done, total);
                                    return true;
                                  });
    }();
    if (!made) return stop(made.error());
    warnOfNotes(program.modules[0].path.c_str(), made->notes);
    uint64_t failed = 0;
    for (size_t s = 0; s < made->outcomes.size(); ++s) {
      const Said said{program, program.expectations[s], made->outcomes[s], settings.seed};
      failed += !said.outcome.holds();
      if (options.json) {
        summary.statements.push_back(toJson(said));
      } else if (said.outcome.holds()) {
        print(said);
      } else {
        // Flush, so that reports precede the following error messages if stdout and stderr have the same destination.
        std::fflush(stdout);
        fmt::print(stderr, "{}", renderDiagnostic(diagnosticOf(said), program.modules[0].text));
      }
    }
    summary.failed += failed;
    if (failed > 0) summary.bad_seeds.push_back(settings.seed);
  }
  if (summary.failed > 0) summary.status = Exit::input;
  return summary;
}

}  // namespace sgm::cli
