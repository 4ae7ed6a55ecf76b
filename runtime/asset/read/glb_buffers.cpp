#include "asset/read/glb_buffers.h"

#include <array>
#include <cstdint>

#include "asset/read/mesh_limits.h"
#include "asset/read/text_reader.h"

namespace sgm::asset {

namespace {

constexpr size_t kNoOffset = SIZE_MAX;  ///< the value for an invalid byteOffset: it is larger than every buffer, so it
                                        ///< is rejected later

/// Decodes standard base64 (RFC 4648), with or without padding. Returns nullopt if a character is invalid.
std::optional<std::vector<std::byte>> decodedBase64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> values;
  values.fill(-1);
  for (size_t i = 0; i < kDigits.size(); ++i) values[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  while (text.ends_with('=')) text.remove_suffix(1);
  std::vector<std::byte> out;
  out.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out.push_back(static_cast<std::byte>(bits >> held & 0xFF));
  }
  return out;
}

/// Returns the stride of a buffer view; nullopt: the elements are contiguous. Some programs write a stride of 0 for
/// contiguous elements.
std::optional<size_t> strideIn(const JsonValue& view) {
  if (view.find("byteStride") == nullptr) return std::nullopt;
  const size_t stride = view.count("byteStride").value_or(kNoOffset);
  return stride == 0 ? std::nullopt : std::optional(stride);
}

std::string compressionOf(const JsonValue& view) {
  const JsonValue* extensions = view.find("extensions");
  if (extensions == nullptr) return {};
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (extensions->find(name) != nullptr) return name;
  return {};
}

}  // namespace

GlbBuffers::GlbBuffers(const JsonValue& root, const GlbContainer& file) {
  const auto buffers = root.list("buffers");
  for (size_t i = 0; i < buffers.size(); ++i) addBuffer(buffers[i], i, file);
  for (const JsonValue& value : root.list("bufferViews"))
    views_.push_back({.buffer = value.count("buffer"),
                      .offset = value.find("byteOffset") == nullptr ? 0 : value.count("byteOffset").value_or(kNoOffset),
                      .length = value.count("byteLength").value_or(0),
                      .stride = strideIn(value),
                      .compression = compressionOf(value)});
}

void GlbBuffers::addBuffer(const JsonValue& value, size_t number, const GlbContainer& file) {
  Buffer& buffer = buffers_.emplace_back();
  const JsonValue* uri = value.find("uri");
  if (uri == nullptr) {
    if (number == 0 && file.has_binary) {
      buffer = {file.binary, file.binary_at, {}};
      bytes_ += file.binary.size();
    } else {
      buffer.problem = "has no bytes in the file";
    }
    return;
  }
  const std::string_view text = uri->text;
  if (!text.starts_with("data:")) {
    buffer.problem = "lies in another file, " + shown(text);
    return;
  }
  constexpr std::string_view kBase64 = ";base64,";
  const size_t begin = text.find(kBase64);
  std::optional<std::vector<std::byte>> bytes;
  if (begin != text.npos) bytes = decodedBase64(text.substr(begin + kBase64.size()));
  if (!bytes) {
    buffer.problem = "has a `data:` URI that is not base64";
    return;
  }
  bytes_ += bytes->size();
  buffer.bytes = decoded_.emplace_back(std::move(*bytes));
}

Result<GlbBuffers::View> GlbBuffers::view(size_t number) const {
  const Said& said = views_[number];
  const std::string pointer = "/bufferViews/" + std::to_string(number);
  const auto wrong = [&](std::string_view what, std::string_view member) {
    return wrongInJson("buffer view " + std::to_string(number) + std::string(what), pointer + std::string(member));
  };
  if (!said.buffer || *said.buffer >= buffers_.size())
    return wrong(" refers to a buffer that does not exist", "/buffer");
  const Buffer& buffer = buffers_[*said.buffer];
  if (!buffer.problem.empty() && !said.compression.empty())
    return wrong(" is compressed by the extension " + shown(said.compression), "/extensions");
  if (!buffer.problem.empty()) {
    const std::string name = std::to_string(*said.buffer);
    return wrongInJson("buffer " + name + " " + buffer.problem, "/buffers/" + name);
  }
  if (said.offset > buffer.bytes.size() || said.length > buffer.bytes.size() - said.offset)
    return wrong(" reaches beyond the end of its buffer", "");
  return View{buffer.bytes.subspan(said.offset, said.length), said.stride, *said.buffer};
}

std::string GlbBuffers::placeOf(size_t buffer, const std::byte* at) const {
  const Buffer& of = buffers_[buffer];
  const size_t offset = static_cast<size_t>(at - of.bytes.data());
  if (of.file_at) return "byte " + std::to_string(*of.file_at + offset);
  return "byte " + std::to_string(offset) + " of buffer " + std::to_string(buffer);
}

}  // namespace sgm::asset
