#include "tools/service/ports/work.h"

#include <algorithm>
#include <new>
#include <utility>
#include <variant>

#include "tools/service/judge/request_bodies.h"
#include "tools/service/ports/embedded_files.h"
#include "tools/service/ports/field_values.h"
#include "tools/service/ports/routes.h"
#include "tools/service/watch/summary_text.h"

namespace sgm::service {
namespace {

using http::Admission;
using http::Problem;
using http::Reply;
using http::Request;
using http::Response;

constexpr uint64_t kMaxMastersBytes = uint64_t{4} << 20;
/// Maximum number of sets of reference histograms that are in memory: being received, or waiting to be written.
constexpr uint64_t kMastersAtOnce = 4;
constexpr size_t kLongestName = 255;

enum Endpoint { summary, chunks, validate, reports, report, preview, masters, description };

constexpr Route kRoutes[] = {
    {"/api/v1/summary", "GET, HEAD", summary},      {"/api/v1/worlds/{name}/chunks", "GET, HEAD", chunks},
    {"/api/v1/validate", "POST", validate},         {"/api/v1/reports", "GET, HEAD", reports},
    {"/api/v1/reports/{id}", "GET, HEAD", report},  {"/api/v1/reports/{id}/preview", "GET, HEAD", preview},
    {"/api/v1/masters", "GET, HEAD, PUT", masters}, {"/api/v1/openapi.json", "GET, HEAD", description},
};

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view typeOf(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  return name.ends_with(".svg") ? "image/svg+xml" : "application/json";
}

const EmbeddedFile* fileNamed(std::string_view name) {
  for (const EmbeddedFile& file : embeddedFiles())
    if (file.name == name) return &file;
  return nullptr;
}

/// Returns the embedded file of the web page for this path; null if there is none. Also null for the description of the
/// HTTP interface, which is embedded too, but does not belong to the page.
const EmbeddedFile* pageFile(std::string_view path) {
  const std::string_view name = path == "/" ? "index.html" : path.substr(1);
  return name.ends_with(".json") ? nullptr : fileNamed(name);
}

Response fileResponse(const EmbeddedFile& file, const Request& request, std::shared_ptr<const std::string> body) {
  Response response;
  response.fields = {{"ETag", std::string(file.tag)}, {"Cache-Control", "no-cache"}};
  if (file.name.ends_with(".html") || file.name.ends_with(".svg"))
    response.fields.push_back({"Content-Security-Policy", kPolicy});
  if (namesTag(request.field("If-None-Match").value_or(""), file.tag)) {
    response.status = 304;
    return response;
  }
  response.type = typeOf(file.name);
  response.body = std::move(body);
  return response;
}

Response jsonResponse(std::string json) { return http::makeResponse(200, "application/json", std::move(json)); }

Response notFound(std::string detail) { return makeResponse(Problem{404, "not_found", std::move(detail), ""}); }

Response responseOf(const MastersAnswer& said) {
  if (said.json == nullptr) return makeResponse(Problem{503, "no_memory", "out of memory: try again", ""});
  Response response;
  response.status = said.status;
  response.type = said.status == 200 ? "application/json" : "application/problem+json";
  response.body = said.json;
  if (said.status == 503) response.fields.push_back({"Retry-After", "5"});
  return response;
}

/// The answer for a failed inspection. Never throws: if memory has run out, the answer has no text.
Response problemOf(const Inspection& said) noexcept {
  Response response;
  response.status = said.status;
  try {
    if (said.status == 503) response.fields.push_back({"Retry-After", "5"});
    response.body = std::make_shared<const std::string>(said.json);
    response.type = "application/problem+json";
  } catch (const std::bad_alloc&) {
    response.body = nullptr;
  }
  return response;
}

/// The answer that tells why an upload is not accepted at present.
Response refusalOf(const Error& error) {
  const bool full = error.code == Code::limit;
  Response response = makeResponse(Problem{503, full ? "queue_full" : "no_validator", error.message, ""});
  if (full) response.fields.push_back({"Retry-After", "5"});
  return response;
}

Admission refused(Response response) {
  Admission admission;
  admission.refusal = std::move(response);
  return admission;
}

/// Whether the header Prefer asks for an answer before the inspection has ended (respond-async, RFC 7240).
bool wantsNoWait(const Request& request) {
  for (const http::Field& field : request.fields) {
    if (inSmallLetters(field.name) != "prefer") continue;
    for (const std::string_view preference : listed(field.value))
      if (mediaType(preference) == "respond-async") return true;
  }
  return false;
}

}  // namespace

Work::Work(const WorkParts& parts, const WorkSettings& settings)
    : parts_(parts),
      settings_(settings),
      room_(std::make_shared<IncomingRoom>()),
      text_room_(std::make_shared<IncomingRoom>()) {
  room_->most = std::max(settings.max_incoming_bytes, settings.max_upload_bytes);
  text_room_->most = kMaxMastersBytes * kMastersAtOnce;
  for (const EmbeddedFile& file : embeddedFiles())
    files_.emplace(file.name, std::make_shared<const std::string>(file.bytes));
}

Admission Work::admit(const Request& request) {
  if (std::optional<Response> refusal = parts_.access.refuse(request)) return refused(std::move(*refusal));
  if (pageFile(request.path) != nullptr) {
    if (request.method == "GET" || request.method == "HEAD") return {};
    constexpr Route kFile[] = {{"/{file}", "GET, HEAD", 0}, {"/", "GET, HEAD", 0}};
    return refused(std::get<Response>(routed(kFile, request)));
  }
  std::variant<Routed, Response> found = routed(kRoutes, request);
  // Check the token before the path: a client without the token must not learn which paths exist.
  if (std::optional<Response> refusal = parts_.access.refuseStranger(request)) return refused(std::move(*refusal));
  if (std::holds_alternative<Response>(found)) return refused(std::get<Response>(std::move(found)));
  switch (std::get<Routed>(found).route->endpoint) {
    case validate:
      return admitUpload(request);
    case masters:
      return request.method == "PUT" ? admitMasters(request) : Admission{};
    default:
      return {};
  }
}

Admission Work::admitUpload(const Request& request) {
  const auto wrong = [](std::string detail) {
    return refused(makeResponse(Problem{400, "bad_parameter", std::move(detail), ""}));
  };
  const std::string_view name = request.parameter("name").value_or("");
  if (name.size() > kLongestName) return wrong("the name must have at most 255 bytes");
  const std::string type = mediaType(request.field("Content-Type").value_or(""));
  const std::optional<UploadKind> kind = uploadKind(type, name);
  if (!kind) {
    return refused(makeResponse(
        Problem{415, "unsupported_type",
                "send a GLB, OBJ, PLY, STL or .sgm file as it is, with its Content-Type (model/gltf-binary, "
                "model/gltf+json, model/obj, model/ply, model/stl, text/x-sgm), or as application/octet-stream with "
                "?name=FILE.glb",
                ""}));
  }
  for (const auto& [key, value] : request.query) {
    if (key == "name") continue;
    const bool known = key == "region" || key == "cell" || key == "seed" || key == "set";
    if (!known) return wrong("there is no parameter '" + key + "': use name, region, cell, seed and set");
    if (*kind != UploadKind::grammar) return wrong("'" + key + "' is for grammars: leave it out for a mesh");
  }
  if (const Result<void> taken = parts_.inspector.wouldTake(); !taken) return refused(refusalOf(taken.error()));
  Result<Upload> upload = Upload::create(settings_.upload_folder);
  if (!upload) {
    return refused(makeResponse(Problem{507, "no_room", "the upload cannot be stored: " + upload.error().message, ""}));
  }
  upload->kind = *kind;
  upload->name = name.empty() ? "upload." + std::string(nameOf(*kind)) : std::string(name);
  for (const auto& [key, value] : request.query)
    if (key != "name") upload->options.emplace_back(key, value);
  Admission admission;
  admission.body = std::make_unique<UploadBody>(std::move(*upload), room_);
  admission.max_bytes = settings_.max_upload_bytes;
  return admission;
}

Admission Work::admitMasters(const Request& request) {
  if (!settings_.masters_writable) {
    return refused(makeResponse(Problem{
        409, "read_only",
        "the built-in reference histograms cannot be replaced: start the service with a database of them", ""}));
  }
  if (mediaType(request.field("Content-Type").value_or("")) != "application/json") {
    return refused(
        makeResponse(Problem{415, "unsupported_type", "reference histograms must be sent as application/json", ""}));
  }
  Admission admission;
  admission.body = std::make_unique<TextBody>(text_room_);
  admission.max_bytes = kMaxMastersBytes;
  return admission;
}

void Work::answer(const Request& request, std::unique_ptr<http::Body> body, Reply reply) {
  if (const EmbeddedFile* file = pageFile(request.path))
    return reply(fileResponse(*file, request, files_.at(file->name)));
  const std::variant<Routed, Response> found = routed(kRoutes, request);
  const Routed& to = std::get<Routed>(found);
  switch (to.route->endpoint) {
    case summary:
      return reply(jsonResponse(summaryText(parts_.state(), parts_.worlds.samples())));
    case chunks: {
      const std::optional<WorldMap> map = parts_.worlds.map(to.values[0]);
      return reply(map ? jsonResponse(chunksText(*map)) : notFound("no world with this name is watched"));
    }
    case validate:
      return judge(request, std::move(body), std::move(reply));
    case reports:
      return reply(jsonResponse(parts_.reports.list()));
    case report: {
      std::optional<std::string> json = parts_.reports.json(to.values[0]);
      return reply(json ? jsonResponse(std::move(*json))
                        : notFound("there is no report with this id; old reports are removed"));
    }
    case preview: {
      Response response;
      response.type = "application/octet-stream";
      response.body = parts_.reports.preview(to.values[0]);
      return reply(response.body ? response
                                 : notFound("there is no report with this id and a preview; old reports are removed"));
    }
    case masters: {
      if (request.method != "PUT")
        return parts_.masters.read([reply](const MastersAnswer& said) { reply(responseOf(said)); });
      TextBody& text = static_cast<TextBody&>(*body);
      const auto share = std::make_shared<IncomingShare>(std::move(text).releaseShare());
      return parts_.masters.write(std::move(text).release(),
                                  [reply, share](const MastersAnswer& said) { reply(responseOf(said)); });
    }
    case description:
      return reply(fileResponse(*fileNamed("openapi.json"), request, files_.at("openapi.json")));
  }
}

void Work::judge(const Request& request, std::unique_ptr<http::Body> body, Reply reply) {
  if (const Result<void> taken = parts_.inspector.wouldTake(); !taken) return reply(refusalOf(taken.error()));
  Upload upload = std::move(static_cast<UploadBody&>(*body)).release();
  const std::string id = parts_.reports.begin(upload.name, upload.kind, upload.bytes());
  const http::Field location{"Location", "/api/v1/reports/" + id};
  const bool waits = !wantsNoWait(request);
  Reports& kept = parts_.reports;
  const Result<void> taken = parts_.inspector.inspect(
      std::move(upload), [&kept, id] { kept.run(id); },
      [&kept, id, location, waits, reply](Inspection said) {
        std::optional<Response> problem;
        if (waits && said.status != 200) problem = problemOf(said);
        // Finish the report before any operation that may fail: an unfinished report is never removed.
        std::string report = kept.finish(id, std::move(said));
        if (!waits) return;
        Response response = problem ? std::move(*problem) : jsonResponse(std::move(report));
        response.fields.push_back(location);
        reply(std::move(response));
      });
  if (!taken) {
    Response response = refusalOf(taken.error());
    kept.finish(id, {503, *response.body, {}});
    return reply(std::move(response));
  }
  if (waits) return;
  Response response = http::makeResponse(202, "application/json", kept.json(id).value_or(""));
  response.fields.push_back(location);
  reply(std::move(response));
}

}  // namespace sgm::service
