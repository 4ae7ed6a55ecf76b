#pragma once
// Meshes chunks on a device of any kind in batches. The CPU meshes the chunks for which the device has no memory, and
// all chunks that the device has not finished when it is lost.

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "backend/backend.h"

namespace sgm {

/// The plan and the memory of one submission to a device.
class DeviceSlot {
 public:
  virtual ~DeviceSlot() = default;
  size_t first = 0;        ///< index in the batch of the slot's first job
  bool submitted = false;  ///< true if work was submitted, even in part: the device must be waited for
  bool stuck = false;      ///< true if it is unknown whether the device has finished; the slot is then never reused
};

/// An open device with everything that was created on it. It exists as long as any batch or mesh of this session.
/// Thread-safe, but a slot must be used by one thread at a time. The destructor waits for the device.
class DeviceSession {
 public:
  virtual ~DeviceSession() = default;

  /// Returns the capabilities of the device. If the device is lost and another session replaces this one, its
  /// capabilities are the same.
  virtual BackendCapabilities capabilities() const = 0;
  /// Same as Backend::batch().
  virtual uint32_t batch() const = 0;

  /// Returns an unused slot. Throws std::bad_alloc.
  virtual std::unique_ptr<DeviceSlot> takeSlot() = 0;
  /// Takes back a slot that takeSlot() has returned.
  virtual void release(std::unique_ptr<DeviceSlot> slot) noexcept = 0;
  /// Plans as many jobs for one submission as fit, from the first job on, but at least one. Returns their number.
  virtual size_t plan(std::span<const ChunkJob> jobs, DeviceSlot& slot) = 0;
  /// Returns the indices of the planned jobs that are uniform: they have no surface, and need no device.
  virtual std::span<const uint32_t> uniform(const DeviceSlot& slot) const = 0;
  /// True if the plan contains work for the device.
  virtual bool hasWork(const DeviceSlot& slot) const = 0;
  /// False if submit() would have to wait for preparations, such as compiling shaders, that now run in the background;
  /// this call starts them if necessary.
  virtual bool ready(const DeviceSlot&) noexcept { return true; }
  /// Submits the planned work. Errors: device_lost, out_of_memory, limit, unsupported. Throws std::bad_alloc.
  virtual Result<void> submit(DeviceSlot& slot) = 0;
  /// Returns true if the device has finished the slot's work; does not wait.
  virtual Result<bool> ended(DeviceSlot& slot) = 0;
  virtual Result<void> await(DeviceSlot& slot) = 0;
  /// Reads the results of a slot whose work has ended. For each planned job, fills its mesh and then calls done(index
  /// of the job); if done returns false, the rest is cancelled. Returns true if the device has begun to copy meshes
  /// that stay in its memory: the slot is then still in use, so wait for it again. Throws std::bad_alloc.
  virtual Result<bool> read(DeviceSlot& slot, std::span<const ChunkJob> jobs, std::span<ChunkMesh> meshes,
                            const std::function<bool(size_t)>& done) = 0;

  /// Same as Backend::upload().
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this device is not external"};
  }
  /// Returns the size of the parts that are on the device now, in bytes.
  virtual uint64_t resident() const { return 0; }
};

/// The slots of a session that no batch uses at the moment. Thread-safe.
class IdleSlots {
 public:
  /// Returns an idle slot; if there is none, the result of make(). Throws std::bad_alloc.
  template <class Make>
  std::unique_ptr<DeviceSlot> take(const Make& make) {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) {
      std::unique_ptr<DeviceSlot> made = make();
      // The capacity is reserved here, so that give() cannot fail.
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
  std::vector<std::unique_ptr<DeviceSlot>> stuck_;  // slots that the device may use until the session ends
};

/// Receives warnings; same as BackendRequest::warn.
using WarnOf = std::function<void(const std::string&)>;
using OpenSession = std::function<Result<std::shared_ptr<DeviceSession>>()>;

/// Creates a backend that meshes on a device. The given CPU backend meshes the chunks for which the device has no
/// memory, and the remaining chunks if the device is lost; its results are the same bytes. open: opens the device;
/// called now and after each loss, by one thread at a time. If it fails after a loss, the CPU does all work. A device
/// that is lost too often in a row is not opened again. warn: receives a message about each loss; may be null. Errors:
/// those of open.
Result<std::unique_ptr<Backend>> makeDeviceBackend(OpenSession open, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler,
                                                   WarnOf warn = nullptr);

}  // namespace sgm
