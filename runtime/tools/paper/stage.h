#pragma once
// Generates one stage of the paper's tables by several backends in turn; measures the times, and compares the meshes.

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

/// The model that a stage generates: a cube of a grammar's world.
struct StageModel {
  std::string_view name;
  std::string_view file;  ///< path of the grammar in the bundle (bundle.h)
  uint64_t seed = 0;
  Int3 low;          ///< corner of the cube, metres
  int32_t edge = 0;  ///< edge of the cube, metres
  /// Values of the parameters that differ from their defaults, SI units.
  std::span<const std::pair<std::string_view, double>> parameters{};
};
/// The models cave, cloud and building, in the order of kPaperStages.
std::span<const StageModel> stageModels();

/// A backend that is measured, or the reason why it cannot be measured.
struct BackendRun {
  std::string name;
  std::string device;
  unsigned workers = 0;              ///< number of concurrent workers; 0: unknown
  std::string reason;                ///< why the backend is not measured; empty if it is
  std::shared_ptr<JobSystem> jobs;   ///< threads for deriving and compiling; null if the backend is not measured
  std::shared_ptr<Backend> backend;  ///< null if it is not measured
};

/// The times of one contender for a stage.
struct StageRow {
  std::string name, device, reason;  ///< as in Contender
  unsigned workers = 0;
  double first = 0;             ///< seconds of the warm-up run, which includes deriving cells and preparing a device
  std::vector<double> seconds;  ///< seconds of each run after the warm-up; empty if the backend is not measured
  uint64_t on_cpu = 0;          ///< number of chunks over all runs that the CPU meshed because the device could not

  bool measured() const { return !seconds.empty(); }
  /// Precondition: measured.
  double median() const;
};

struct StageResult {
  const StageModel* model = nullptr;
  int32_t cell = 0;  ///< edge of a grid cell, in units
  IntBox extent;     ///< bounds of all chunks that meet the cube
  uint64_t chunks = 0, triangles = 0;
  /// Number of evaluated instructions of field programs: for each program after pruning to a brick, its length times
  /// the number of samples and vertices. Counted in a separate run by the scalar evaluator.
  uint64_t operations = 0;
  ContentHash hash;            ///< hash of the set of chunk meshes; equal in every run of every contender
  std::vector<StageRow> rows;  ///< one row for each contender
};

/// The results of a row, each by one formula of the paper.
struct StageFigures {
  double seconds = 0;                ///< median of the measured times
  double speedup = 0;                ///< equation 2, relative to the first row
  std::optional<double> efficiency;  ///< equation 3; nullopt if the number of workers is unknown
  double throughput = 0;             ///< equation 4: operations per second
};
/// Precondition: the row and the result's first row are measured.
StageFigures figuresOf(const StageResult& result, const StageRow& row);

/// Generates the stage once with each contender, then `runs` times with all contenders in turn. A run begins with
/// derived cells and ends with packed meshes, and each contender has its own world. `step` is called after every run.
/// Errors: those of meshing; bad_input if the meshes of two contenders differ; the message names both.
Result<StageResult> measureStage(const StageModel& model, int32_t cell, uint64_t runs,
                                 std::span<const BackendRun> backend_runs, const std::function<void()>& step);

}  // namespace sgm::cli
