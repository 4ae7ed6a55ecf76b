#pragma once
// Meshes chunks on a device in batches; the CPU meshes those that the device cannot, or loses. For all kinds of
// devices.

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "backend/backend.h"

namespace sgm {

/// The plan and the memory of one submission.
class DeviceSlot {
 public:
  virtual ~DeviceSlot() = default;
  size_t first = 0;        ///< index of the first of the batch's jobs
  bool submitted = false;  ///< in whole or in part: must be waited for
  bool stuck = false;      ///< it is unknown whether the device is done with it
};

/// A device with everything created on it; lives as long as any batch or mesh of it. Thread-safe, but each slot is for
/// one thread at a time. Its destructor waits for the device.
class DeviceSession {
 public:
  virtual ~DeviceSession() = default;

  /// The same for every session that replaces this one.
  virtual BackendCapabilities capabilities() const = 0;
  /// As Backend::batch().
  virtual uint32_t batch() const = 0;

  /// Returns an unused slot. Throws std::bad_alloc.
  virtual std::unique_ptr<DeviceSlot> takeSlot() = 0;
  /// Returns a slot of takeSlot() to the session.
  virtual void release(std::unique_ptr<DeviceSlot> slot) noexcept = 0;
  /// Plans jobs for one submission. Returns the number of planned jobs, counted from the first; at least one.
  virtual size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) = 0;
  /// Indices of jobs that need no device: they have no surface, and are uniform.
  virtual std::span<const uint32_t> uniform(const DeviceSlot& slot) const = 0;
  /// Whether there is anything to submit.
  virtual bool hasWork(const DeviceSlot& slot) const = 0;
  /// Whether submit() would not wait for the device's preparation; if false, preparation has begun.
  virtual bool ready(const DeviceSlot&) noexcept { return true; }
  /// Errors: device_lost, out_of_memory, limit, unsupported. Throws std::bad_alloc.
  virtual Result<void> submit(DeviceSlot& slot) = 0;
  /// Whether the device is done with it; does not wait.
  virtual Result<bool> ended(DeviceSlot& slot) = 0;
  virtual Result<void> await(DeviceSlot& slot) = 0;
  /// Call after the end: fills one mesh for each planned job, and calls done(index of the job), which returns whether
  /// to continue. Returns true if the device works in the slot again, for meshes that stay on it: then wait again.
  /// Throws std::bad_alloc.
  virtual Result<bool> read(DeviceSlot& slot, std::span<const ChunkJob> jobs, std::span<ChunkMesh> meshes,
                            const std::function<bool(size_t)>& done) = 0;

  /// As Backend::upload().
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this device is not external"};
  }
  /// Bytes of parts on the device now.
  virtual uint64_t resident() const { return 0; }
};

/// Slots of a session that no batch uses. Thread-safe.
class IdleSlots {
 public:
  /// Returns an idle slot, or make() if there is none. Throws std::bad_alloc.
  template <class Make>
  std::unique_ptr<DeviceSlot> take(const Make& make) {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) {
      std::unique_ptr<DeviceSlot> made = make();
      // Reserve, so that give() needs no memory.
      idle_.reserve(made_ + 1);
      stuck_.reserve(made_ + 1);
      ++made_;
      return made;
    }
    std::unique_ptr<DeviceSlot> slot = std::move(idle_.back());
    idle_.pop_back();
    return slot;
  }
  void give(std::unique_ptr<DeviceSlot> slot) noexcept {
    slot->submitted = false;
    const std::scoped_lock lock(mutex_);
    (slot->stuck ? stuck_ : idle_).push_back(std::move(slot));
  }

 private:
  std::mutex mutex_;
  size_t made_ = 0;
  std::vector<std::unique_ptr<DeviceSlot>> idle_;
  std::vector<std::unique_ptr<DeviceSlot>> stuck_;  // the device may use them until its end
};

/// As BackendRequest::warn.
using WarnOf = std::function<void(const std::string&)>;
using OpenSession = std::function<Result<std::shared_ptr<DeviceSession>>()>;

/// Meshes on a device, and on the given CPU backend if the device has no room or is lost; the stream continues with the
/// same bytes. open: called now and after each loss, by one thread at a time; an error after a loss means that the CPU
/// does all. A device lost too often in a row is given up. warn: receives each loss; may be null. Errors: as open.
Result<std::unique_ptr<Backend>> makeDeviceBackend(OpenSession open, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler,
                                                   WarnOf warn = nullptr);

}  // namespace sgm
