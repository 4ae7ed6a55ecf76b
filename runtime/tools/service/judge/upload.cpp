#include "tools/service/judge/upload.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/plain_text.h"

namespace sgm::service {
namespace {

struct KindName {
  UploadKind kind;
  std::string_view name;  ///< file name extension without its dot
};
constexpr KindName kNames[] = {
    {UploadKind::glb, "glb"}, {UploadKind::obj, "obj"},     {UploadKind::ply, "ply"},
    {UploadKind::stl, "stl"}, {UploadKind::grammar, "sgm"}, {UploadKind::glb, "gltf"},
};

struct KindType {
  std::string_view type;
  UploadKind kind;
};
constexpr KindType kTypes[] = {
    {"model/gltf-binary", UploadKind::glb}, {"model/gltf+json", UploadKind::glb},   {"model/obj", UploadKind::obj},
    {"model/ply", UploadKind::ply},         {"application/x-ply", UploadKind::ply}, {"model/stl", UploadKind::stl},
    {"text/x-sgm", UploadKind::grammar},
};

std::string lowered(std::string_view text) {
  std::string low(text);
  for (char& c : low) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return low;
}

Error failed(const std::string& what) { return {Code::io, what + ": " + systemMessage(errno)}; }

}  // namespace

std::string_view nameOf(UploadKind kind) { return std::ranges::find(kNames, kind, &KindName::kind)->name; }

std::optional<UploadKind> uploadKind(std::string_view content_type, std::string_view name) {
  std::string type = lowered(content_type.substr(0, content_type.find(';')));
  type.erase(std::remove_if(type.begin(), type.end(), [](char c) { return c == ' ' || c == '\t'; }), type.end());
  if (!type.empty() && type != "application/octet-stream") {
    const auto* of = std::ranges::find(kTypes, std::string_view(type), &KindType::type);
    return of == std::end(kTypes) ? std::nullopt : std::optional(of->kind);
  }
  const size_t point = name.rfind('.');
  if (point == std::string_view::npos) return std::nullopt;
  const std::string ending = lowered(name.substr(point + 1));
  const auto* of = std::ranges::find(kNames, std::string_view(ending), &KindName::name);
  return of == std::end(kNames) ? std::nullopt : std::optional(of->kind);
}

Result<Upload> Upload::create(const std::string& folder) {
  std::string in = folder;
  if (in.empty()) {
    std::error_code why;
    in = std::filesystem::temp_directory_path(why).string();
    if (why) return Error{Code::io, "there is no folder for temporary files: " + systemMessage(why)};
  }
  platform::File file(platform::openScratchFile(in));
  if (!file) return failed("cannot make a file in " + in);
  return Upload(std::move(file));
}

Result<void> Upload::append(std::string_view piece) {
  while (!piece.empty()) {
    const ptrdiff_t written = platform::writeNext(file(), piece.data(), piece.size());
    if (written <= 0) return failed("cannot write a temporary file");
    bytes_ += static_cast<uint64_t>(written);
    piece.remove_prefix(static_cast<size_t>(written));
  }
  return {};
}

}  // namespace sgm::service
