#include "tools/service/judge/reports.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <list>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "tools/service/judge/inspector_json.h"

namespace sgm::service {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kNoMemory =
    R"({"type":"about:blank","title":"Internal Server Error","status":500,"code":"out_of_memory",)"
    R"("detail":"the service is out of memory and cannot keep this report: send the request again later"})";
constexpr size_t kMaxReports = 64, kMaxBytes = size_t{128} << 20;

std::string_view nameOf(ReportState state) {
  switch (state) {
    case ReportState::waiting:
      return "waiting";
    case ReportState::running:
      return "running";
    case ReportState::done:
      return "done";
    case ReportState::failed:
      return "failed";
    case ReportState::cancelled:
      return "cancelled";
  }
  return "";
}

std::string newId() {
  std::array<unsigned char, 8> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    std::random_device random;
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
  }
  std::string id;
  for (const unsigned char byte : bytes) {
    constexpr char kHex[] = "0123456789abcdef";
    id += {kHex[byte >> 4], kHex[byte & 15]};
  }
  return id;
}

std::string nowText() {
  const std::time_t now = std::time(nullptr);
  std::tm at{};
  gmtime_r(&now, &at);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &at)};
}

/// Names of the members that a report gets in addition to those from its inspection.
constexpr std::array<std::string_view, 8> kHeadNames{"id",       "name",  "kind",  "bytes",
                                                     "received", "state", "valid", "seconds"};

void add(std::string& object, std::string_view name, std::string_view value) {
  object += object.ends_with('{') ? "\"" : ",\"";
  object.append(name).append("\":").append(value);
}

}  // namespace

struct KeptReport {
  std::string id, name, received;
  UploadKind kind = UploadKind::glb;
  uint64_t bytes = 0;
  ReportState state = ReportState::waiting;
  Clock::time_point began{};
  std::optional<double> seconds;  ///< duration of the inspection; nullopt until it has ended
  std::optional<bool> valid;
  std::string text;           ///< the complete report as JSON; empty until the inspection has ended
  std::string out_of_memory;  ///< the report's JSON for the case that memory runs out; made in advance
  std::shared_ptr<const std::string> preview;

  bool finished() const { return state != ReportState::waiting && state != ReportState::running; }
  size_t size() const { return text.size() + (preview ? preview->size() : 0); }

  /// The report's short form (a JSON object) in the list of reports.
  std::string head() const {
    const std::string_view judged = valid.value_or(false) ? "true" : "false";
    const std::array<std::string, kHeadNames.size()> values{jsonString(id),
                                                            jsonString(name),
                                                            jsonString(nameOf(kind)),
                                                            std::to_string(bytes),
                                                            jsonString(received),
                                                            jsonString(nameOf(state)),
                                                            std::string(valid ? judged : "null"),
                                                            seconds ? nlohmann::json(*seconds).dump() : "null"};
    std::string object = "{";
    for (size_t i = 0; i < values.size(); ++i) add(object, kHeadNames[i], values[i]);
    return object + "}";
  }
};

namespace {

/// Value of the report's member "preview": the inspection's data on the preview mesh, and its URL; "null" if there is
/// no preview.
std::string previewText(const KeptReport& report, std::string_view said) {
  if (!report.preview || !said.starts_with('{')) return "null";
  std::string text = "{";
  for (const auto& [name, value] : membersOf(said))
    if (name != "url") add(text, name, value);
  add(text, "url", "\"/api/v1/reports/" + report.id + "/preview\"");
  return text + "}";
}

/// The JSON of a finished report: its own members, then those of the inspection. The texts are joined, since parsed
/// JSON would need many times the memory.
std::string finishedText(const KeptReport& report, std::string_view said) {
  std::string text = report.head();
  text.pop_back();
  if (report.state != ReportState::done) {
    add(text, "problem", said.empty() ? "{}" : said);
    return text + "}";
  }
  std::string preview = "null";
  for (const auto& [name, value] : membersOf(said)) {
    if (name == "preview") {
      preview = previewText(report, value);
    } else if (std::ranges::find(kHeadNames, name) == kHeadNames.end()) {
      add(text, name, value);
    }
  }
  add(text, "preview", preview);
  return text + "}";
}

void fill(KeptReport& report, Inspection inspection) {
  if (report.state == ReportState::running)
    report.seconds = std::chrono::duration<double>(Clock::now() - report.began).count();
  const bool read = inspection.status == 200;
  report.state = read ? ReportState::done : inspection.status == 503 ? ReportState::cancelled : ReportState::failed;
  if (read) {
    const std::vector<JsonMember> members = membersOf(inspection.json);
    report.valid = std::ranges::any_of(
        members, [](const JsonMember& member) { return member.name == "valid" && member.value == "true"; });
    if (!inspection.preview.empty())
      report.preview = std::make_shared<const std::string>(std::move(inspection.preview));
  }
  report.text = finishedText(report, inspection.json);
}

/// Marks a report as failed because memory has run out. Allocates no memory.
void failForMemory(KeptReport& report) noexcept {
  report.state = ReportState::failed;
  report.text = std::move(report.out_of_memory);
}

std::string outOfMemoryText(KeptReport report) {
  report.state = ReportState::failed;
  return finishedText(report, kNoMemory);
}

}  // namespace

/// The stored reports, newest first.
struct Reports::Kept {
  mutable std::mutex mutex;
  std::list<KeptReport> reports;

  std::list<KeptReport>::iterator find(const std::string& id) {
    return std::find_if(reports.begin(), reports.end(), [&](const KeptReport& report) { return report.id == id; });
  }

  /// Removes the oldest finished reports, except `wanted`, until the stored reports are within the limits. Returns the
  /// removed reports, so that the caller can free them without the lock.
  std::list<KeptReport> takeSurplus(const KeptReport* wanted) {
    size_t bytes = 0;
    for (const KeptReport& report : reports) bytes += report.size();
    std::list<KeptReport> surplus;
    for (auto at = reports.end(); at != reports.begin() && (reports.size() > kMaxReports || bytes > kMaxBytes);) {
      --at;
      if (!at->finished() || &*at == wanted) continue;
      bytes -= at->size();
      surplus.splice(surplus.begin(), reports, at++);
    }
    return surplus;
  }
};

Reports::Reports() : kept_(std::make_unique<Kept>()) {}
Reports::~Reports() = default;

std::string Reports::begin(const std::string& name, UploadKind kind, uint64_t bytes) {
  std::list<KeptReport> made(1), surplus;
  KeptReport& report = made.front();
  report.name = name;
  report.kind = kind;
  report.bytes = bytes;
  report.received = nowText();
  std::string id;
  const std::lock_guard lock(kept_->mutex);
  do id = newId();
  while (kept_->find(id) != kept_->reports.end());
  report.id = id;
  report.out_of_memory = outOfMemoryText(report);
  kept_->reports.splice(kept_->reports.begin(), made);
  surplus = kept_->takeSurplus(&report);
  return id;
}

void Reports::run(const std::string& id) {
  const std::lock_guard lock(kept_->mutex);
  const auto found = kept_->find(id);
  if (found == kept_->reports.end()) return;
  found->state = ReportState::running;
  found->began = Clock::now();
}

std::string Reports::finish(const std::string& id, Inspection inspection) {
  std::list<KeptReport> surplus;
  try {
    KeptReport report;
    {
      const std::lock_guard lock(kept_->mutex);
      const auto found = kept_->find(id);
      if (found == kept_->reports.end()) return {};
      report = *found;
    }
    // Fill the report without holding the lock, because this takes some milliseconds.
    fill(report, std::move(inspection));
    report.out_of_memory = {};
    std::string text = report.text;
    const std::lock_guard lock(kept_->mutex);
    const auto found = kept_->find(id);
    if (found == kept_->reports.end()) return text;
    *found = std::move(report);
    surplus = kept_->takeSurplus(&*found);
    return text;
  } catch (const std::bad_alloc&) {
    const std::lock_guard lock(kept_->mutex);
    const auto found = kept_->find(id);
    if (found == kept_->reports.end()) return {};
    failForMemory(*found);
    surplus = kept_->takeSurplus(&*found);
  }
  try {
    return json(id).value_or("");
  } catch (const std::bad_alloc&) {
    return {};
  }
}

std::optional<std::string> Reports::json(const std::string& id) const {
  const std::lock_guard lock(kept_->mutex);
  const auto found = kept_->find(id);
  if (found == kept_->reports.end()) return std::nullopt;
  return found->finished() ? found->text : found->head();
}

std::shared_ptr<const std::string> Reports::preview(const std::string& id) const {
  const std::lock_guard lock(kept_->mutex);
  const auto found = kept_->find(id);
  return found == kept_->reports.end() ? nullptr : found->preview;
}

std::string Reports::list() const {
  std::string list;
  const std::lock_guard lock(kept_->mutex);
  for (const KeptReport& report : kept_->reports) list.append(list.empty() ? "" : ",").append(report.head());
  return "{\"reports\":[" + list + "]}";
}

size_t Reports::size() const {
  const std::lock_guard lock(kept_->mutex);
  return kept_->reports.size();
}

}  // namespace sgm::service
