#include "store/block_cache.h"

#include <algorithm>
#include <new>

namespace sgm::store {
namespace {

Error outOfMemory() { return {Code::out_of_memory, "out of memory"}; }

}  // namespace

std::pair<std::shared_ptr<BlockCache::Block>, bool> BlockCache::find(const Key& key) {
  if (const auto known = blocks_.find(key); known != blocks_.end()) {
    used_.splice(used_.begin(), used_, known->second.used);
    return {known->second.block, false};
  }
  auto block = std::make_shared<Block>(Block{std::pmr::vector<std::byte>(memory_), std::nullopt});
  used_.push_front(key);
  try {
    blocks_.emplace(key, Entry{block, used_.begin()});
  } catch (...) {
    used_.pop_front();
    throw;
  }
  if (blocks_.size() > kMaxBlocks) {
    // The block leaves the cache, but other threads that wait for it still get its data: they share ownership of it.
    blocks_.erase(used_.back());
    used_.pop_back();
  }
  return {std::move(block), true};
}

void BlockCache::claim(Wanted& wanted, size_t count) {
  wanted.blocks.reserve(count);
  wanted.is_mine.reserve(count);
  const std::lock_guard lock(mutex_);
  while (wanted.blocks.size() < count) {
    auto [block, is_new] = find({wanted.file, wanted.first + wanted.blocks.size()});
    wanted.blocks.push_back(std::move(block));
    wanted.is_mine.push_back(is_new);
  }
}

void BlockCache::finish(Wanted& wanted, size_t number, std::span<const std::byte> bytes) {
  std::pmr::vector<std::byte> own(bytes.begin(), bytes.end(), memory_);
  {
    const std::lock_guard lock(mutex_);
    wanted.blocks[number]->bytes = std::move(own);
    wanted.blocks[number]->is_done = true;
    wanted.is_mine[number] = false;
  }
  finished_.notify_all();
}

void BlockCache::fail(Wanted& wanted, size_t number, Error error) noexcept {
  {
    const std::lock_guard lock(mutex_);
    Block& block = *wanted.blocks[number];
    block.error = std::move(error);
    block.is_done = true;
    wanted.is_mine[number] = false;
    const auto known = blocks_.find({wanted.file, wanted.first + number});
    if (known != blocks_.end() && known->second.block.get() == &block) {
      used_.erase(known->second.used);
      blocks_.erase(known);
    }
  }
  finished_.notify_all();
}

void BlockCache::fetchMine(Wanted& wanted, uint64_t file_bytes, const Fetch& fetch) {
  const size_t count = wanted.blocks.size();
  for (size_t from = 0; from < count; ++from) {
    if (!wanted.is_mine[from]) continue;
    size_t to = from;
    while (to < count && wanted.is_mine[to] && to - from < kMaxConcurrent) ++to;
    const uint64_t begin = (wanted.first + from) * kBlock;
    const uint64_t end = std::min<uint64_t>((wanted.first + to) * kBlock, file_bytes);
    Result<std::pmr::vector<std::byte>> got = fetch(begin, static_cast<size_t>(end - begin));
    if (got && got->size() != end - begin) got = Error{Code::io, "a file is shorter than expected"};
    for (size_t i = from; i < to; ++i) {
      if (!got) {
        fail(wanted, i, got.error());
        continue;
      }
      const std::span<const std::byte> rest = std::span(*got).subspan((i - from) * kBlock);
      finish(wanted, i, rest.first(std::min(rest.size(), kBlock)));
    }
  }
}

Result<std::pmr::vector<std::byte>> BlockCache::read(uint64_t file, uint64_t file_bytes, uint64_t offset, size_t bytes,
                                                     const Fetch& fetch, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::byte> content(bytes, memory);
  if (bytes == 0) return content;
  Wanted wanted{file, offset / kBlock, {}, {}};
  const auto giveUp = [&] {
    // Marks the blocks that this thread has claimed but not fetched as failed. Otherwise other threads would wait for
    // them forever.
    for (size_t i = 0; i < wanted.is_mine.size(); ++i) {
      if (wanted.is_mine[i]) fail(wanted, i, outOfMemory());
    }
  };
  try {
    claim(wanted, static_cast<size_t>((offset + bytes - 1) / kBlock - wanted.first + 1));
    fetchMine(wanted, file_bytes, fetch);
  } catch (const std::bad_alloc&) {
    giveUp();
    throw;
  }
  std::unique_lock lock(mutex_);
  for (size_t i = 0; i < wanted.blocks.size(); ++i) {
    const Block& block = *wanted.blocks[i];
    finished_.wait(lock, [&] { return block.is_done; });
    if (block.error && block.error->code == Code::out_of_memory) throw std::bad_alloc();
    if (block.error) return *block.error;
    const uint64_t begin = (wanted.first + i) * kBlock;
    const uint64_t from = std::max(begin, offset), to = std::min<uint64_t>(begin + block.bytes.size(), offset + bytes);
    if (to < std::min<uint64_t>(begin + kBlock, offset + bytes))
      return Error{Code::io, "a file is shorter than expected"};
    std::copy_n(block.bytes.begin() + static_cast<ptrdiff_t>(from - begin), to - from,
                content.begin() + static_cast<ptrdiff_t>(from - offset));
  }
  return content;
}

}  // namespace sgm::store
