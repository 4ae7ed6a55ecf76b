#include "tools/preview/painter.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "base/jobs.h"
#include "region/places.h"
#include "tools/render/ray_caster.h"
#include "tools/render/sketch.h"
#include "tools/support/drawable_region.h"
#include "tools/support/source.h"
#include "world/fitting_cell.h"

namespace sgm::preview {
namespace {

using cli::Region;
using cli::RegionScene;
using cli::RenderOptions;

constexpr uint64_t kChunks = 2048;      // maximum number of chunks in the region of a picture, if --cell is not given
constexpr uint64_t kDraftChunks = 256;  // maximum number of chunks in a draft, the coarse first version of a picture
constexpr int kCoarsestDraft = 4;  // maximum number of levels of detail by which a draft is coarser than its picture
constexpr double kDraftPixels = 90'000;

std::string pointText(const std::array<double, 3>& p) { return fmt::format("{},{},{}", p[0], p[1], p[2]); }
std::string boxText(const IntBox& box) {
  const auto corner = [](Int3 p) { return pointText({metres(p.x), metres(p.y), metres(p.z)}); };
  return corner(box.lo) + ":" + corner(box.hi);
}

/// Whether a camera is so far inside a box that the box contains most of the camera's view.
bool isWithin(const IntBox& box, const std::array<double, 3>& camera) {
  for (int axis = 0; axis < 3; ++axis) {
    const double margin = (metres(box.hi[axis]) - metres(box.lo[axis])) / 4, at = camera[static_cast<size_t>(axis)];
    if (at < metres(box.lo[axis]) + margin || at > metres(box.hi[axis]) - margin) return false;
  }
  return true;
}

/// The size of a draft: the same aspect ratio as `size`, with at most kDraftPixels pixels.
std::string draftSize(const std::string& size) {
  const cli::PictureSize whole = *cli::readSize(size);
  const double smaller = std::max(1.0, std::sqrt(whole.width * (whole.height / kDraftPixels)));
  return fmt::format("{}x{}", std::max(1, static_cast<int>(whole.width / smaller)),
                     std::max(1, static_cast<int>(whole.height / smaller)));
}

/// The files that a grammar consists of. Modules of the standard library are omitted, because they are not on disk.
std::vector<std::filesystem::path> filesOf(const std::string& file, const CompileResult& compiled) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::vector<std::filesystem::path> files{file};
  for (const SourceFile& source : compiled.files) files.push_back(folder / source.path);
  if (compiled.program)
    for (const Asset& asset : compiled.program->assets) files.push_back(folder / std::string(asset.path));
  return files;
}

/// Selects the assignments that the grammar accepts; the others are reported in `messages`.
std::vector<std::string> takenSets(const Program& program, const std::vector<std::string>& sets,
                                   std::string& messages) {
  std::vector<std::string> taken;
  for (const std::string& set : sets) {
    if (const Result<ParameterValues> fits = cli::parameterValues(program, {set}); !fits)
      messages += fmt::format("note: {} is ignored: {}\n", set, fits.error().message);
    else
      taken.push_back(set);
  }
  return taken;
}

}  // namespace

/// State that only the painting thread uses.
struct Painter::Worker {
  Painter& painter;
  Renderer renderer;
  std::unique_ptr<JobSystem> jobs;

  std::optional<uint64_t> edition;
  std::shared_ptr<const Program> program;
  std::string compile_messages;
  std::vector<std::filesystem::path> files;  ///< files that were read, but are not yet part of a published result

  std::string world;          ///< key of the world to which the regions `draft` and `fine` belong
  std::optional<IntBox> box;  ///< region of the world that the picture shows
  std::shared_ptr<const Region> draft, fine;
  std::string home;  ///< the camera that was chosen automatically, for requests that give none
  Light light = Light::sun;

  Worker(Painter& owner, Renderer drawer, std::unique_ptr<JobSystem> threads)
      : painter(owner), renderer(std::move(drawer)), jobs(std::move(threads)) {}

  void paint(const DrawRequest& request, uint64_t number);

 private:
  /// The request that is being processed.
  struct Task {
    const DrawRequest& request;
    uint64_t number;
    RenderOptions options;
    int draft_level = 0;
    std::string messages;
    cli::Stopwatch watch;
  };

  void read(const DrawRequest& request);
  Result<void> settle(Task& task);
  Result<std::shared_ptr<const Region>> meshed(const Task& task, int level, bool draft_only);
  Result<void> paintDraft(Task& task);
  Result<void> paintFine(Task& task);
  Painted result(const Task& task);
};

void Painter::Worker::read(const DrawRequest& request) {
  edition = request.edition;
  const Result<CompileResult> compiled = cli::compileFile(request.options.file);
  if (!compiled) {
    compile_messages = compiled.error().message + "\n";
    files = {request.options.file};
    program = nullptr;
    return;
  }
  compile_messages = renderDiagnostics(*compiled);
  files = filesOf(request.options.file, *compiled);
  program = compiled->program;
}

Result<void> Painter::Worker::settle(Task& task) {
  RenderOptions& options = task.options;
  options.sets = takenSets(*program, options.sets, task.messages);
  const bool chosen = options.region.empty() && program->domain.infinite;
  if (!options.region.empty()) {
    const Result<IntBox> given = cli::parseRegion(options.region);
    if (!given) return given.error();
    box = *given;
  } else if (!chosen) {
    box = program->domain.box;
  } else if (!box || (!options.camera.empty() && !isWithin(*box, (*cli::readCamera(options.camera))[0]))) {
    WorldFieldSettings settings;
    settings.program = program;
    settings.parameters = *cli::parameterValues(*program, options.sets);
    settings.seed = options.seed;
    std::optional<cli::RegionDensity> no_density;
    const cli::RegionPlan plan = cli::picturePlan(options, no_density);
    const Result<IntBox> around = plan.choose(WorldField(std::move(settings), std::pmr::new_delete_resource()));
    if (!around) return around.error();
    box = *around;
  }
  if (!options.cell && !options.density) {
    const Result<int32_t> fitting = cellFor(std::span(&*box, 1), std::min(kChunks, options.max_chunks));
    if (!fitting) return fitting.error();
    options.cell = metres(*fitting);
  }
  const Result<int32_t> cell = cli::cellUnits(options);
  if (!cell) return cell.error();
  task.draft_level = 1;
  while (task.draft_level < kCoarsestDraft && countChunks(*box, int64_t{*cell} << task.draft_level) > kDraftChunks)
    ++task.draft_level;
  options.region = boxText(*box);

  std::string key = fmt::format("{} {} {} {} {}", *edition, options.seed, *cell, options.sharp, options.region);
  for (const std::string& set : options.sets) key += " " + set;
  if (key != world) {
    draft = fine = nullptr;
    world = std::move(key);
  }
  return {};
}

Result<std::shared_ptr<const Region>> Painter::Worker::meshed(const Task& task, int level, bool draft_only) {
  RenderOptions options = task.options;
  // Use a world with coarser cells instead of a coarse level of the picture's world: the coarse level would still be
  // derived and sampled at the fine cell size of its world.
  options.cell = std::ldexp(*options.cell, level);
  std::optional<cli::RegionDensity> no_density;
  cli::RegionPlan plan = cli::picturePlan(options, no_density);
  plan.quiet = true;
  plan.notes = !draft_only;
  // Anchors are needed only once, to choose the camera.
  plan.anchors = options.camera.empty() && home.empty();
  if (!draft_only) plan.go_on = [this, number = task.number] { return painter.isNewest(number); };
  Result<Region> made = cli::meshProgram(program, options, plan);
  if (!made) return made.error();
  if (!plan.anchors) options.at.clear();
  if (const Result<void> drawable = cli::checkDrawable(options, *made); !drawable) return drawable.error();
  return std::shared_ptr<const Region>(std::make_shared<Region>(std::move(*made)));
}

Painted Painter::Worker::result(const Task& task) {
  Painted painted;
  painted.request = task.number;
  painted.program = program;
  painted.text_is_wrong = program == nullptr;
  painted.files = std::exchange(files, {});
  painted.messages = compile_messages + task.messages;
  painted.box = task.options.region;
  painted.cell = task.options.cell.value_or(0);
  painted.seconds = task.watch.seconds();
  return painted;
}

Result<void> Painter::Worker::paintDraft(Task& task) {
  if (!draft) {
    Result<std::shared_ptr<const Region>> made = meshed(task, task.draft_level, true);
    if (!made) return made.error();
    draft = std::move(*made);
  }
  RenderOptions options = task.options;
  options.size = draftSize(options.size);
  if (options.camera.empty()) options.camera = home;
  Result<RegionScene> drawn = cli::sceneOf(options, *draft);
  if (!drawn) return drawn.error();
  light = drawn->light;
  if (options.camera.empty()) home = cli::gazeText(cli::worldGaze(drawn->view.camera, draft->meshed.mesh.origin));
  const Result<RayCaster> tree = RayCaster::over(drawn->vertices, drawn->indices);
  if (!tree) return tree.error();
  Result<Image> image = sketch(drawn->scene, *tree, *jobs);
  if (!image) return image.error();

  Painted painted = result(task);
  painted.region = draft;
  painted.image = std::move(*image);
  painted.view = std::move(drawn->view);
  painted.light = drawn->light;
  painted.draft = true;
  painter.publish(std::move(painted));
  return {};
}

Result<void> Painter::Worker::paintFine(Task& task) {
  if (!fine) {
    Result<std::shared_ptr<const Region>> made = meshed(task, 0, false);
    if (!made) return made.error();
    fine = std::move(*made);
  }
  RenderOptions options = task.options;
  if (options.camera.empty()) options.camera = home;
  if (!cli::lightNamed(options.light)) options.light = cli::lightName(light);
  Result<RegionScene> drawn = cli::sceneOf(options, *fine);
  if (!drawn) return drawn.error();
  drawn->scene.go_on = [this, number = task.number] { return painter.isNewest(number); };
  Result<Image> image = renderer.render(drawn->scene);
  if (!image) return image.error();

  if (!fine->notes.empty()) {
    const DeriveNote& note = fine->notes.front();
    task.messages += fmt::format("{}:{}:{}: warning: {} ({} notes, this one first in {})\n", task.request.options.file,
                                 note.line, note.column, note.message, fine->notes.size(), note.path);
  }
  Painted painted = result(task);
  painted.region = fine;
  painted.image = std::move(*image);
  painted.view = std::move(drawn->view);
  painted.light = drawn->light;
  painter.publish(std::move(painted));
  return {};
}

void Painter::Worker::paint(const DrawRequest& request, uint64_t number) {
  Task task{request, number, request.options, 0, {}, {}};
  const auto work = [&]() -> Result<void> {
    if (edition != request.edition) read(request);
    if (program == nullptr) return {};
    if (const Result<void> settled = settle(task); !settled) return settled.error();
    if (const Result<void> drawn = paintDraft(task); !drawn) return drawn.error();
    if (!painter.isNewest(number)) return Error{Code::cancelled, {}};
    return paintFine(task);
  };
  Result<void> done;
  try {
    done = work();
  } catch (const std::bad_alloc&) {
    done = Error{Code::out_of_memory, "out of memory: choose larger cells (--cell) or a smaller --region"};
  }
  if (program != nullptr && (done || done.error().code == Code::cancelled)) return;
  if (!done) task.messages += "error: " + done.error().message + "\n";
  painter.publish(result(task));
}

Result<std::unique_ptr<Painter>> Painter::create() {
  Result<Renderer> renderer = Renderer::create();
  if (!renderer) return renderer.error();
  Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(0, {}, "sgm preview");
  if (!jobs) return jobs.error();
  std::unique_ptr<Painter> painter(new Painter);
  painter->worker_ = std::make_unique<Worker>(*painter, std::move(*renderer), std::move(*jobs));
  try {
    painter->thread_ = std::thread([raw = painter.get()] { raw->run(); });
  } catch (const std::system_error&) {
    return Error{Code::limit, "cannot start another thread: end other programs and try again"};
  }
  return painter;
}

Painter::~Painter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

uint64_t Painter::request(DrawRequest request) {
  uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    request_ = std::move(request);
    number = ++requested_;
  }
  changed_.notify_all();
  return number;
}

std::optional<Painted> Painter::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

void Painter::publish(Painted painted) {
  const std::lock_guard lock(mutex_);
  // The files of a grammar are published only once, so take them over from a result that take() has not returned yet.
  if (painted.files.empty() && result_) painted.files = std::move(result_->files);
  result_ = std::move(painted);
}

void Painter::run() {
  uint64_t begun = 0;
  for (;;) {
    DrawRequest request;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ending_ || requested_ != begun; });
      if (ending_) return;
      begun = requested_;
      request = request_;
    }
    worker_->paint(request, begun);
  }
}

}  // namespace sgm::preview
