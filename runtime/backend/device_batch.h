#pragma once
// Chunks on a device, in batches; the CPU takes what the device cannot, or loses. The same for every kind of device.

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
  size_t first = 0;        ///< of the batch's jobs
  bool submitted = false;  ///< in whole or in part: it has to be waited for
  bool stuck = false;      ///< nobody could say that the device has done with it
};

/// A device with all that is made on it, for as long as any batch of it or any mesh on it lives. Any thread may use it,
/// a slot by one. Its end waits for the device.
class DeviceSession {
 public:
  virtual ~DeviceSession() = default;

  /// The same of every session that is opened in place of this one.
  virtual BackendCapabilities capabilities() const = 0;
  /// As Backend::batch().
  virtual uint32_t batch() const = 0;

  /// One that nobody uses. Throws std::bad_alloc.
  virtual std::unique_ptr<DeviceSlot> takeSlot() = 0;
  /// Gives back what takeSlot gave.
  virtual void release(std::unique_ptr<DeviceSlot> slot) noexcept = 0;
  /// Plans jobs for one submission; how many of them were taken up, from the first on, at least one.
  virtual size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) = 0;
  /// Numbers of those that need no device: they have no surface, and are uniform.
  virtual std::span<const uint32_t> uniform(const DeviceSlot& slot) const = 0;
  /// Whether there is anything to submit.
  virtual bool hasWork(const DeviceSlot& slot) const = 0;
  /// Whether submit() would not wait until the device is ready; where not it is being made so.
  virtual bool ready(const DeviceSlot&) noexcept { return true; }
  /// Errors: device_lost, out_of_memory, limit, unsupported. Throws std::bad_alloc.
  virtual Result<void> submit(DeviceSlot& slot) = 0;
  /// Whether the device has done with it; does not wait.
  virtual Result<bool> ended(DeviceSlot& slot) = 0;
  virtual Result<void> await(DeviceSlot& slot) = 0;
  /// After the end: fills the mesh of each job that was made, a mesh a job, and calls done(number of the job), which
  /// says whether to go on. true: the device is at work in the slot once more, for meshes that stay on it, and has to
  /// be waited for again. Throws std::bad_alloc.
  virtual Result<bool> read(DeviceSlot& slot, std::span<const ChunkJob> jobs, std::span<ChunkMesh> meshes,
                            const std::function<bool(size_t)>& done) = 0;

  /// As Backend::upload().
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "no engine lent this device"};
  }
  /// Bytes of parts that lie on it now.
  virtual uint64_t resident() const { return 0; }
};

/// Slots of a session that no batch has. Any thread may use it.
class IdleSlots {
 public:
  /// One of them, or where there is none what make() gives. Throws std::bad_alloc.
  template <class Make>
  std::unique_ptr<DeviceSlot> take(const Make& make) {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) {
      std::unique_ptr<DeviceSlot> made = make();
      // So that to give it back takes no memory.
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
  std::vector<std::unique_ptr<DeviceSlot>> stuck_;  // the device may use them still, to the end
};

/// As BackendRequest::warn.
using WarnOf = std::function<void(const std::string&)>;
using OpenSession = std::function<Result<std::shared_ptr<DeviceSession>>()>;

/// Meshes what a device has no room for, or loses, by the CPU backend that it is given; the stream goes on, with the
/// same bytes. open: called now, and anew after a loss, where an error means that the CPU does all; by one thread at a
/// time. What is lost too often in a row is left alone. warn: told of each loss; or null. Errors: as open.
Result<std::unique_ptr<Backend>> makeDeviceBackend(OpenSession open, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler,
                                                   WarnOf warn = nullptr);

}  // namespace sgm
