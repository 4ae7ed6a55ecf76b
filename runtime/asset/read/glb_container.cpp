#include "asset/read/glb_container.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "asset/read/mesh_limits.h"
#include "asset/read/mesh_notes.h"

namespace sgm::asset {

namespace {

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

uint32_t wordAt(std::span<const std::byte> bytes, size_t at) {
  uint32_t word = 0;  // copied as it is: the file and all supported machines are little-endian
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Returns the offset of the next chunk. Chunks must be padded to four bytes; some programs pad, but do not count the
/// padding in the chunk's length.
size_t endOfPart(std::span<const std::byte> bytes, size_t at, size_t size) {
  const size_t end = at + size, padded = at + (size + 3) / 4 * 4;
  const auto holdsPart = [&](size_t from) {
    return bytes.size() >= from + kChunkHeaderBytes && wordAt(bytes, from + 4) == kBinaryChunk &&
           wordAt(bytes, from) <= bytes.size() - from - kChunkHeaderBytes;
  };
  if (end != padded && holdsPart(end) && !holdsPart(padded)) return end;
  return std::min(padded, bytes.size());
}

}  // namespace

bool beginsAsGltf(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  // Search the whole text, since programs write the member `asset` anywhere in the object, often last.
  return begin != std::string_view::npos && text[begin] == '{' && text.find("\"asset\"") != std::string_view::npos;
}

Result<GlbContainer> openGlb(std::span<const std::byte> bytes) {
  GlbContainer out;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (bytes.size() < sizeof kMagic || wordAt(bytes, 0) != kMagic) {
    if (!beginsAsGltf(text)) return Error{Code::bad_input, "it is not a GLB file: it does not begin with `glTF`", 0, 0};
    out.json = text;
    out.is_text = true;
    return out;
  }
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) return wrongAtByte("it ends within its header", bytes.size());
  if (wordAt(bytes, 4) != 2)
    return wrongAtByte("it is glTF of version " + std::to_string(wordAt(bytes, 4)) + ", not 2", 4);
  const size_t said = wordAt(bytes, 8);
  if (said > bytes.size() || said < kHeaderBytes + kChunkHeaderBytes)
    return wrongAtByte(
        "its header declares " + std::to_string(said) + " bytes, and the file has " + std::to_string(bytes.size()), 8);
  if (said < bytes.size())
    out.notes.push_back(counted(bytes.size() - said, "byte after its end is", "bytes after its end are") +
                        " left out, at " + byteText(said));
  bytes = bytes.first(said);
  size_t at = kHeaderBytes;
  for (size_t number = 0; bytes.size() - at >= kChunkHeaderBytes; ++number) {
    const size_t size = wordAt(bytes, at), begin = at + kChunkHeaderBytes;
    const uint32_t kind = wordAt(bytes, at + 4);
    if (size > bytes.size() - begin) return wrongAtByte("a chunk of it reaches beyond its end", at);
    if (number == 0 && kind != kJsonChunk) return wrongAtByte("its first chunk is not JSON", at + 4);
    if (number == 0) out.json = text.substr(begin, size);
    if (number == 1 && kind == kBinaryChunk) {
      out.binary = bytes.subspan(begin, size);
      out.has_binary = true;
      out.binary_at = begin;
    }
    if (size % 4 != 0)
      out.notes.push_back("the length of a chunk is not a multiple of 4 (" + std::to_string(size) + "), at " +
                          byteText(at));
    at = endOfPart(bytes, begin, size);
  }
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; out.json.starts_with(kByteOrderMark))
    out.json.remove_prefix(kByteOrderMark.size());
  // The JSON chunk must be padded with spaces, but some programs pad it with zero bytes.
  if (const size_t end = out.json.find_last_not_of('\0') + 1; end < out.json.size()) {
    out.notes.push_back("its JSON is padded with zero bytes, not with blanks");
    out.json = out.json.substr(0, end);
  }
  return out;
}

}  // namespace sgm::asset
