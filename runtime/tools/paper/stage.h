#pragma once
// Generates one stage of the paper's tables with several backends in turn, measures the times, and compares the meshes.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/backend.h"
#include "grammar/syntax/program.h"
#include "mesh/hash.h"

namespace sgm::cli {

/// The model that is meshed in a stage: a cube in the world of a grammar.
struct StageModel {
  std::string_view name;
  std::string_view file;  ///< path of the grammar in the bundle (bundle.h)
  uint64_t seed = 0;
  Int3 low;          ///< corner of the cube, metres
  int32_t edge = 0;  ///< edge of the cube, metres
  /// Names and values (SI units) of the grammar parameters that differ from their defaults.
  std::span<const std::pair<std::string_view, double>> parameters{};
};
/// The models cave, cloud and building, in the order of kPaperStages.
std::span<const StageModel> stageModels();

/// A backend to measure, or the reason why it cannot be measured.
struct BackendRun {
  std::string name;
  std::string device;
  unsigned workers = 0;              ///< number of concurrent workers; 0: unknown
  std::string reason;                ///< why the backend is not measured; empty if it is measured
  std::shared_ptr<JobSystem> jobs;   ///< threads that derive and compile; null if the backend is not measured
  std::shared_ptr<Backend> backend;  ///< null if the backend is not measured
};

/// The times of one backend run in a stage.
struct StageRow {
  std::string name, device, reason;  ///< name, device and reason of the BackendRun
  unsigned workers = 0;
  double first = 0;             ///< seconds of the warm-up run, in which cells are derived and the device is prepared
  std::vector<double> seconds;  ///< seconds of each run after the warm-up; empty if the backend is not measured
  uint64_t on_cpu = 0;          ///< number of chunks, over all runs, that the CPU meshed because the device could not

  bool measured() const { return !seconds.empty(); }
  /// Precondition: measured.
  double median() const;
};

struct StageResult {
  const StageModel* model = nullptr;
  int32_t cell = 0;  ///< edge of a grid cell, in units
  IntBox extent;     ///< bounding box of all chunks that intersect the cube
  uint64_t chunks = 0, triangles = 0;
  /// Number of instructions of field programs that are evaluated. Each brick (block of samples) has its own pruned
  /// program; the length of this program times the number of its samples and vertices is added up over all bricks.
  /// Counted in a separate run by the scalar evaluator.
  uint64_t operations = 0;
  ContentHash hash;            ///< hash of all chunk meshes, which is the same for every backend and run
  std::vector<StageRow> rows;  ///< one row for each backend run
};

/// The results derived from the times of a row by the formulas of the paper.
struct StageFigures {
  double seconds = 0;                ///< median of the measured times
  double speedup = 0;                ///< equation 2: speedup relative to the first row of the result
  std::optional<double> efficiency;  ///< equation 3: speedup per worker; nullopt if the number of workers is unknown
  double throughput = 0;             ///< equation 4: operations per second
};
/// Computes the results of a row. Precondition: this row and the first row of the result are measured.
StageFigures figuresOf(const StageResult& result, const StageRow& row);

/// Generates the stage once with each backend, to warm up, then `runs` times with all backends in turn. Each backend
/// has its own world, whose grammar cells are derived in the first run and cached for the later runs. A run ends when
/// the meshes are packed. step: called after every run. Errors: those of meshing; bad_input if the meshes of two
/// backends differ, with the names of both.
Result<StageResult> measureStage(const StageModel& model, int32_t cell, uint64_t runs,
                                 std::span<const BackendRun> backend_runs, const std::function<void()>& step);

}  // namespace sgm::cli
