#include "store/frames.h"

#include <zstd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <new>

namespace sgm::store {
namespace {

// zstd level for baked content; tests/bench/README.md compares time and size of other levels
constexpr int kZstdLevel = 9;

}  // namespace

Result<void> available() { return {}; }

ContentId idOf(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

IdStream::IdStream() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_));
}
IdStream::~IdStream() { XXH3_freeState(static_cast<XXH3_state_t*>(state_)); }
void IdStream::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), bytes.data(), bytes.size());
}
ContentId IdStream::id() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state_));
  return {hash.high64, hash.low64};
}

uint64_t checksumOf(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte> content, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::byte> frame(ZSTD_compressBound(content.size()), memory);
  const size_t bytes = ZSTD_compress(frame.data(), frame.size(), content.data(), content.size(), kZstdLevel);
  if (ZSTD_isError(bytes)) return Error{Code::out_of_memory, "out of memory while packing a chunk"};
  frame.resize(bytes);
  return frame;
}

std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                  std::pmr::memory_resource* memory) {
  return Unpacker().unpack(frame, content_bytes, memory);
}

Unpacker::~Unpacker() {
  for (void* context : idle_) ZSTD_freeDCtx(static_cast<ZSTD_DCtx*>(context));
}

std::optional<std::pmr::vector<std::byte>> Unpacker::unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                            std::pmr::memory_resource* memory) {
  // Checks the size in the frame's header before memory for the content is allocated.
  if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != content_bytes) return std::nullopt;
  std::pmr::vector<std::byte> content(content_bytes, memory);
  ZSTD_DCtx* context = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      context = static_cast<ZSTD_DCtx*>(idle_.back());
      idle_.pop_back();
    } else {
      idle_.reserve(made_ + 1);
      context = ZSTD_createDCtx();
      if (context == nullptr) throw std::bad_alloc();
      ++made_;
    }
  }
  // zstd returns an error as a number that is larger than every valid size, so the comparison also detects errors.
  const size_t bytes = ZSTD_decompressDCtx(context, content.data(), content.size(), frame.data(), frame.size());
  {
    const std::lock_guard lock(mutex_);
    idle_.push_back(context);
  }
  if (bytes != content_bytes) return std::nullopt;
  return content;
}

}  // namespace sgm::store
