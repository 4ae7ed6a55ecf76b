#include "tools/service/judge/inspector_answer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "tools/service/judge/inspector_json.h"

namespace sgm::service {
namespace {

constexpr std::string_view kPreviewMagic = "SGMPREV1";
constexpr size_t kPreviewHead = 16;

template <class T>
T numberAt(std::string_view bytes, size_t at) {
  T value = 0;
  for (size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<T>(value | T{static_cast<unsigned char>(bytes[at + i])} << (8 * i));
  return value;
}

/// Removes the next part (JSON or preview) from the process's output. Returns nullopt if the part is incomplete.
std::optional<std::string_view> takePart(std::string_view& left) {
  if (left.size() < sizeof(uint64_t)) return std::nullopt;
  const uint64_t size = numberAt<uint64_t>(left, 0);
  left.remove_prefix(sizeof size);
  if (size > left.size()) return std::nullopt;
  const std::string_view part = left.substr(0, size);
  left.remove_prefix(size);
  return part;
}

bool isPreview(std::string_view bytes) {
  if (bytes.size() < kPreviewHead || !bytes.starts_with(kPreviewMagic)) return false;
  const uint64_t points = numberAt<uint32_t>(bytes, 8), triangles = numberAt<uint32_t>(bytes, 12);
  if (bytes.size() != kPreviewHead + 12 * points + 12 * triangles) return false;
  for (size_t at = kPreviewHead + 12 * points; at < bytes.size(); at += 4)
    if (numberAt<uint32_t>(bytes, at) >= points) return false;
  return true;
}

/// The JSON text of the value of the member `name`; empty if there is no such member.
std::string_view valueOf(const std::vector<JsonMember>& members, std::string_view name) {
  const auto found = std::ranges::find(members, name, &JsonMember::name);
  return found == members.end() ? std::string_view() : found->value;
}

/// The status of a problem (RFC 9457). Returns nullopt if the JSON is no problem, or has a status that the process must
/// not use.
std::optional<int> problemStatus(const std::vector<JsonMember>& members, Answer wanted) {
  for (const char* member : {"type", "title", "code", "detail"})
    if (!valueOf(members, member).starts_with('"')) return std::nullopt;
  const std::string_view status = valueOf(members, "status");
  for (const int of_reports : {422, 500})
    if (status == std::to_string(of_reports)) return of_reports;
  for (const int of_masters : {400, 409})
    if (wanted == Answer::masters && status == std::to_string(of_masters)) return of_masters;
  return std::nullopt;
}

bool isWanted(const std::vector<JsonMember>& members, Answer wanted) {
  if (!valueOf(members, "status").empty()) return false;
  if (wanted == Answer::masters)
    return valueOf(members, "masters").starts_with('[') && valueOf(members, "limits").starts_with('[');
  const std::string_view valid = valueOf(members, "valid");
  return (valid == "true" || valid == "false") && valueOf(members, "measures").starts_with('{');
}

Inspection limitReached(const std::string& what) { return problemOf(500, "validator_limit", what); }

Inspection tooMuchSaid(size_t most) {
  return limitReached("the answer is larger than " + std::to_string(most >> 20) + " MB, the limit of the service");
}

/// Parses a process's output. Returns nullopt if it is not a valid answer of the wanted kind.
std::optional<Inspection> soundAnswer(std::string_view output, Answer wanted) {
  const std::optional<std::string_view> text = takePart(output), preview = takePart(output);
  if (!text || !preview || !output.empty()) return std::nullopt;
  if (wanted == Answer::report && text->size() > kMaxReportText) return tooMuchSaid(kMaxReportText);
  if (!isSoundObject(*text)) return std::nullopt;
  const std::vector<JsonMember> members = membersOf(*text);
  Inspection said;
  said.json = *text;
  if (const std::optional<int> status = problemStatus(members, wanted)) {
    said.status = *status;
    return said;
  }
  if (!isWanted(members, wanted) || !(preview->empty() || isPreview(*preview))) return std::nullopt;
  said.valid = wanted == Answer::report && valueOf(members, "valid") == "true";
  said.preview = *preview;
  return said;
}

std::string firstLine(std::string_view text) {
  constexpr size_t kMost = 300;
  const std::string_view line = text.substr(0, std::min(text.find('\n'), kMost));
  return line.empty() ? std::string() : ": " + std::string(line);
}

const char* titleOf(int status) {
  switch (status) {
    case 409:
      return "Conflict";
    case 503:
      return "Service Unavailable";
    default:
      return "Internal Server Error";
  }
}

Inspection crashed(const std::string& how) { return problemOf(500, "validator_crashed", "the validator " + how); }

}  // namespace

Inspection problemOf(int status, std::string_view code, std::string_view detail) {
  std::string json = R"({"type":"about:blank","title":)" + jsonString(titleOf(status));
  json.append(R"(,"status":)").append(std::to_string(status));
  json.append(R"(,"code":)").append(jsonString(code));
  json.append(R"(,"detail":)").append(jsonString(detail)).append("}");
  return {status, std::move(json), {}};
}

Inspection stoppedProblem() {
  return problemOf(503, "stopping", "the service is stopping: send the request again when it is back");
}

Inspection outOfMemoryProblem() noexcept {
  Inspection said;
  said.status = 500;
  try {
    said.json = R"({"type":"about:blank","title":"Internal Server Error","status":500,"code":"validator_limit",)"
                R"("detail":"the service is out of memory: send the request again later"})";
  } catch (const std::bad_alloc&) {
    // There is no memory for the problem's text: return only the status.
  }
  return said;
}

Inspection inspectionOf(const platform::ProcessOutput& said, std::chrono::seconds time, Answer wanted) {
  using Stop = platform::ProcessOutput::Stop;
  using Kind = platform::ProcessExit::Kind;
  const std::string seconds = std::to_string(time.count());
  switch (said.stop) {
    case Stop::cancelled:
      return stoppedProblem();
    case Stop::time_limit:
      return limitReached("the validation takes more than " + seconds +
                          " s, the time limit of the service: send a smaller file");
    case Stop::output_limit:
      return tooMuchSaid(kMaxAnswer);
    case Stop::none:
      break;
  }
  switch (said.exit.kind) {
    case Kind::out_of_time:
      return limitReached("the validation takes more than " + seconds +
                          " s of processor time, the limit of the service: send a smaller file");
    case Kind::crashed:
    case Kind::killed:
    case Kind::ended:
      return crashed("was ended by signal " + std::to_string(said.exit.number) +
                     (said.exit.kind == Kind::killed ? ": the machine may be out of memory"
                                                     : ": this is a bug in sgm, please send us the file"));
    case Kind::exited:
      if (said.exit.number != 0)
        return crashed("ended with status " + std::to_string(said.exit.number) + firstLine(said.error));
      break;
    case Kind::unknown:
      break;
  }
  if (std::optional<Inspection> answer = soundAnswer(said.output, wanted)) return std::move(*answer);
  return crashed((said.output.empty() ? "ended without an answer" : "returned something other than a report") +
                 firstLine(said.error));
}

}  // namespace sgm::service
