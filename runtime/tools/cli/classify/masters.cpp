// `sgm masters`: builds the reference histograms with which `classify` compares meshes, and lists them.

#include <fmt/core.h>

#include "backend/open/open_backend.h"
#include "tools/classify/build.h"
#include "tools/cli/classify/commands.h"
#include "tools/cli/classify/master_key.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"

namespace sgm::cli {
namespace {

/// The class names of the reference histograms, with the number of histograms of each class.
std::vector<std::pair<std::string, size_t>> classesOf(const std::vector<measure::Master>& masters) {
  std::vector<std::pair<std::string, size_t>> classes;
  for (const measure::Master& master : masters) {
    if (classes.empty() || classes.back().first != master.class_name) classes.emplace_back(master.class_name, 0);
    ++classes.back().second;
  }
  return classes;
}

std::string summaryOf(const masters::MasterSet& set) {
  std::string text;
  for (const measure::MasterLimits& limits : set.limits) {
    text += fmt::format("  {}:", textOf(limits.key));
    for (const auto& [name, count] : classesOf(set.of(limits.key))) text += fmt::format(" {} {}", count, name);
    text += fmt::format("; unknown above MSE {:.3g} or EMD {:.3g}\n", limits.mse, limits.emd);
  }
  return text;
}

Json keysJson(const masters::MasterSet& set) {
  Json keys = Json::array();
  for (const measure::MasterLimits& limits : set.limits) {
    Json masters = Json::array();
    for (const measure::Master& m : set.of(limits.key)) {
      masters.push_back({{"class", m.class_name}, {"name", m.name}, {"models", m.models}, {"shares", m.shares}});
    }
    keys.push_back(
        {{"key", toJson(limits.key)}, {"limits", {{"mse", limits.mse}, {"emd", limits.emd}}}, {"masters", masters}});
  }
  return keys;
}

Result<masters::MasterSet> build(const MastersBuildOptions& options) {
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  const Result<std::unique_ptr<Backend>> backend =
      makeBackend(BackendRequest{}, **jobs, std::pmr::new_delete_resource());
  if (!backend) return backend.error();
  ProgressBar bar("models");
  const Result<std::vector<masters::Specimen>> specimens = masters::specimensOf(
      masters::families(), options.models, options.seed, **backend, **jobs, [&bar](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
  if (!specimens) return specimens.error();
  return masters::mastersOf(*specimens);
}

}  // namespace

Exit buildMasters(const MastersBuildOptions& options) {
  const std::string out = options.out.empty() && options.emit.empty() ? masters::defaultBase().string() : options.out;
  if (out.empty() && options.emit.empty()) {
    return reportError(Exit::usage, "neither $XDG_DATA_HOME nor $HOME is set: name the database with --out");
  }
  // Check first that the output file is writable, since building takes long.
  if (!out.empty()) {
    if (options.out.empty()) {
      if (const Result<masters::OpenedBase> there = mastersOf({}); !there) return reportError(there.error());
    }
    if (const Result<void> can = masters::checkWritable(out); !can) return reportError(can.error());
  }
  std::optional<FileWriter> source;
  if (!options.emit.empty()) {
    Result<FileWriter> writer = FileWriter::create(options.emit, &unfinished_files);
    if (!writer) return reportError(writer.error());
    source.emplace(std::move(*writer));
  }
  const Stopwatch watch;
  const Result<masters::MasterSet> set = build(options);
  if (!set) return reportError(set.error());
  if (source) {
    source->write(masters::sourceOf(
        *set, fmt::format("sgm masters build --models {} --seed {} --emit FILE", options.models, options.seed)));
    if (const Result<void> done = source->commit(); !done) return reportError(done.error());
    fmt::print("{}: ", options.emit);
  }
  if (!out.empty()) {
    if (const Result<void> done = masters::writeBase(out, *set); !done) return reportError(done.error());
    fmt::print("{}: ", out);
  }
  fmt::print("{} reference histograms of {} models, {:.1f} s\n{}", set->masters.size(),
             options.models * masters::families().size(), watch.seconds(), summaryOf(*set));
  return Exit::done;
}

Exit listMasters(const MastersListOptions& options) {
  const Result<masters::OpenedBase> base = mastersOf(options.file);
  if (!base) return reportError(base.error());
  if (options.json) {
    fmt::print("{}\n", Json{{"masters", base->from}, {"keys", keysJson(base->set)}}.text());
    return Exit::done;
  }
  fmt::print("{}: {} reference histograms\n{}", base->from, base->set.masters.size(), summaryOf(base->set));
  for (const measure::MasterLimits& limits : base->set.limits) {
    fmt::print("\n{}\n", textOf(limits.key));
    for (const measure::Master& m : base->set.of(limits.key)) fmt::print("  {} ({} models)\n", m.name, m.models);
  }
  return Exit::done;
}

}  // namespace sgm::cli
