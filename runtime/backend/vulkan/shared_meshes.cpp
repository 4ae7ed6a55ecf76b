#include "backend/vulkan/shared_meshes.h"

#include <new>

#include "backend/vulkan/device_meshes.h"

namespace sgm::vulkan {
namespace {

struct Placed final : MeshPlacement {
  ~Placed() override {
    if (writing) DeviceMeshes::abandon(placed);
  }
  PlacedParts placed;
};

class SharedMeshes final : public MeshStore, public std::enable_shared_from_this<SharedMeshes> {
 public:
  static Result<std::shared_ptr<MeshStore>> open(const BorrowedDevice& external) {
    const auto meshes = std::make_shared<SharedMeshes>();
    if (const Result<void> made = meshes->make(external); !made) return made.error();
    return std::shared_ptr<MeshStore>(meshes);
  }

  SharedMeshes() = default;
  ~SharedMeshes() override {
    if (queue_) queue_->drain();
  }
  SharedMeshes(const SharedMeshes&) = delete;
  SharedMeshes& operator=(const SharedMeshes&) = delete;

  const DeviceId& device() const override { return device_->info().id; }

  bool lost() const override { return queue_->lost(); }

  std::unique_ptr<MeshPlacement> place(std::span<const PartSizes> chunks) override {
    auto placement = std::make_unique<Placed>();
    if (lost()) {
      placement->chunks.resize(chunks.size());
      return placement;
    }
    placement->placed = meshes_->place(shared_from_this(), chunks);
    placement->chunks = placement->placed.chunks;
    for (const PlacedParts::Part& part : placement->placed.parts) {
      placement->parts.push_back({part.chunk, part.part, part.placed->memory().buffer().block(),
                                  part.placed->vertexOffset(), part.placed->indexOffset()});
    }
    return placement;
  }

  Result<void> publish(MeshPlacement& base) noexcept override {
    auto& placement = static_cast<Placed&>(base);
    placement.writing = false;
    placement.held.clear();
    try {
      return meshes_->acquire(placement.placed);
    } catch (const std::bad_alloc&) {
      return Error{Code::out_of_memory, "out of memory"};
    }
  }

  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    auto brought = meshes_->upload(shared_from_this(), parts);
    if (brought || brought.error().code != Code::device_lost) return brought;
    return Error{Code::unsupported, brought.error().message};
  }
  uint64_t bytes() override { return meshes_->bytes(); }

 private:
  Result<void> make(const BorrowedDevice& external) {
    Result<std::unique_ptr<Device>> device = Device::borrow(external);
    if (!device) return device.error();
    device_ = std::move(*device);
    Result<std::unique_ptr<Queue>> queue = Queue::create(*device_);
    if (!queue) return queue.error();
    queue_ = std::move(*queue);
    staging_ = std::make_unique<Memory>(*device_);
    MemoryOptions options;
    options.cap = external.resident_cap;
    options.families = external.readers;
    options.shared = true;
    memory_ = std::make_unique<Memory>(*device_, options);
    Result<std::unique_ptr<CommandRing>> ring = CommandRing::create(*queue_);
    if (!ring) return ring.error();
    ring_ = std::move(*ring);
    meshes_ = std::make_unique<DeviceMeshes>(*queue_, *memory_, *staging_, *ring_);
    return {};
  }

  std::unique_ptr<Device> device_;
  std::unique_ptr<Queue> queue_;
  std::unique_ptr<Memory> staging_, memory_;
  std::unique_ptr<CommandRing> ring_;
  std::unique_ptr<DeviceMeshes> meshes_;
};

}  // namespace

Result<std::shared_ptr<MeshStore>> openSharedMeshes(const BorrowedDevice& external) {
  return SharedMeshes::open(external);
}

}  // namespace sgm::vulkan
