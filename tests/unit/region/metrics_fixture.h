#pragma once
// For tests: functions that make a world and measure it in a single call.

#include <memory>
#include <string>

#include "backend/open/open_backend.h"
#include "catch.h"
#include "grammar/compile.h"
#include "region/expectations.h"
#include "region/region.h"

namespace sgm::test {

inline constexpr int32_t kMetre = kUnitsPerMetre;

inline std::shared_ptr<const Program> compiled(const std::string& text, ImportResolver* resolver = nullptr) {
  CompileOptions options;
  options.resolver = resolver;
  const CompileResult result = compileGrammar(text, "test.sgm", options);
  INFO(text << '\n' << renderDiagnostics(result));
  REQUIRE(result.program);
  return result.program;
}

/// A compiled grammar, with the threads and the backend that measure its world.
class World {
 public:
  explicit World(const std::string& text, ImportResolver* resolver = nullptr) : program_(compiled(text, resolver)) {
    Result<std::unique_ptr<JobSystem>> threads = makeThreadPool(2);
    REQUIRE(threads);
    jobs_ = std::move(*threads);
    Result<std::unique_ptr<Backend>> made = makeBackend({}, *jobs_, std::pmr::get_default_resource());
    REQUIRE(made);
    backend_ = std::move(*made);
  }

  const Program& program() const { return *program_; }
  Backend& backend() const { return *backend_; }
  JobSystem& jobs() const { return *jobs_; }

  RegionMeasures measured(double cell, const IntBox& region, const WantedMeasures& wanted = {true, true, true}) const {
    WorldFieldSettings settings;
    settings.program = program_;
    settings.parameters = ParameterValues::defaults(*program_);
    settings.finest_cell = static_cast<int32_t>(cell * kUnitsPerMetre);
    const WorldField world(settings, std::pmr::get_default_resource());
    const Result<RegionMeasures> result = measureRegion(world, *backend_, *jobs_, region, 65536, wanted);
    INFO((result ? "" : result.error().message));
    REQUIRE(result);
    return *result;
  }

  ExpectationSettings settings(uint64_t seed = 0) const {
    ExpectationSettings s;
    s.program = program_;
    s.parameters = ParameterValues::defaults(*program_);
    s.seed = seed;
    return s;
  }

  Evaluation evaluated(const ExpectationSettings& settings) const {
    Result<Evaluation> result = evaluateExpectations(settings, *backend_, *jobs_, std::pmr::get_default_resource());
    INFO((result ? "" : result.error().message));
    REQUIRE(result);
    REQUIRE(result->outcomes.size() == program_->expectations.size());
    return std::move(*result);
  }
  Evaluation evaluated(uint64_t seed = 0) const { return evaluated(settings(seed)); }

 private:
  std::shared_ptr<const Program> program_;
  std::unique_ptr<JobSystem> jobs_;
  std::unique_ptr<Backend> backend_;
};

/// Measures the whole world of a grammar with a finite domain and one rule. shapes: the statements of the rule.
inline RegionMeasures regionOfShapes(const std::string& shapes, double cell) {
  const World world("sgm 1; start A; rule A { " + shapes + " }");
  return world.measured(cell, world.program().domain.box);
}

}  // namespace sgm::test
