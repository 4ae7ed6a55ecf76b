// Reads and stores the reference histograms of the metrics service.

#include <filesystem>

#include "tools/classify/set_json.h"
#include "tools/cli/classify/commands.h"
#include "tools/cli/classify/inspect.h"
#include "tools/cli/classify/master_key.h"

namespace sgm::cli {
namespace {

/// The key as JSON in the form that readSet() reads; unlike in toJson(), a length or density of 0 is not null.
Json keyJson(const measure::MasterKey& key) {
  return {{"mode", measure::nameOf(key.mode)},
          {"bins", key.bins},
          {"length", key.length},
          {"density", key.density},
          {"version", key.version}};
}

Json mastersJson(const masters::OpenedBase& base, bool writable) {
  Json masters = Json::array(), limits = Json::array();
  for (const measure::Master& m : base.set.masters) {
    masters.push_back({{"class", m.class_name},
                       {"name", m.name},
                       {"models", m.models},
                       {"key", keyJson(m.key)},
                       {"shares", m.shares}});
  }
  for (const measure::MasterLimits& l : base.set.limits)
    limits.push_back({{"key", keyJson(l.key)}, {"mse", l.mse}, {"emd", l.emd}});
  return {{"from", base.from}, {"writable", writable}, {"masters", masters}, {"limits", limits}};
}

Json unusable(const Error& error) {
  InspectProblem problem;
  problem.status = 500;
  problem.code = "masters_unusable";
  problem.detail = error.message;
  return toJson(problem);
}

}  // namespace

Result<masters::OpenedBase> inspectedBase(const std::string& file) {
  std::error_code why;
  const bool built_in =
      file.empty() || std::filesystem::status(file, why).type() == std::filesystem::file_type::not_found;
  if (built_in) return masters::OpenedBase{masters::builtInMasters(), "built in", {}};
  return mastersOf(file);
}

Json listedMasters(const InspectOptions& options) {
  const Result<masters::OpenedBase> base = inspectedBase(options.masters);
  return base ? mastersJson(*base, !options.masters.empty()) : unusable(base.error());
}

Json storedMasters(std::span<const std::byte> json, const InspectOptions& options) {
  masters::ReadSet read = masters::readSet({reinterpret_cast<const char*>(json.data()), json.size()});
  if (!read.set) {
    InspectProblem problem;
    if (read.malformed) {
      problem.status = 400;
      problem.code = "bad_json";
    }
    problem.detail = read.pointer.empty() ? read.what : read.what + ", at " + read.pointer;
    problem.pointer = read.pointer;
    return toJson(problem);
  }
  if (const Result<void> written = masters::writeBase(options.masters, *read.set); !written)
    return unusable(written.error());
  return listedMasters(options);
}

}  // namespace sgm::cli
