#include "fake_gpu.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "cuda/driver_device.h"
#include "cuda/kernels/kernels.h"
#include "host_device.h"

namespace sgm::cuda {

namespace {

std::mutex fake_mutex;
FakeState fake_state;
thread_local int fake_depth = 0;  ///< number of contexts in this thread's stack of current contexts
std::unique_ptr<Device> fake_host;
std::unique_ptr<Stream> fake_runs;  ///< stream that runs the kernels
std::set<void*> fake_blocks;        ///< allocated blocks
char fake_function[static_cast<size_t>(Kernel::count)];
int fake_things[3];

/// The work that a stream has not executed yet. It is executed only when the program waits, or queries for the second
/// time.
struct FakeStream {
  std::deque<std::function<void()>> queued;
  uint64_t given = 0;  ///< number of pieces of work submitted so far

  void give(std::function<void()> piece) {
    queued.push_back(std::move(piece));
    ++given;
  }
  uint64_t done() const { return given - queued.size(); }
  void finish(uint64_t pieces) {
    while (done() < pieces) {
      queued.front()();
      queued.pop_front();
    }
  }
};
struct FakeEvent {
  FakeStream* stream = nullptr;
  uint64_t after = 0;  ///< the event occurs when the stream has done this many pieces of work
  bool asked = false;
};
/// Imported memory of another API, in the form in which Mesa's software device shares it: a file with a header that
/// contains the offset of the memory.
class FakeImport {
 public:
  FakeImport(int descriptor, uint64_t bytes) : bytes_(bytes) {
    struct stat file;
    if (fstat(descriptor, &file) != 0) return;
    size_ = static_cast<size_t>(file.st_size);
    void* const mapped = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (mapped == MAP_FAILED) return;
    file_ = static_cast<std::byte*>(mapped);
    std::memcpy(&offset_, file_ + sizeof(uint64_t), sizeof offset_);
  }
  ~FakeImport() {
    if (file_ != nullptr) munmap(file_, size_);
  }
  FakeImport(const FakeImport&) = delete;
  FakeImport& operator=(const FakeImport&) = delete;
  std::byte* begin() const { return file_ != nullptr && offset_ + bytes_ <= size_ ? file_ + offset_ : nullptr; }
  uint64_t bytes() const { return bytes_; }

 private:
  uint64_t bytes_, offset_ = 0;
  size_t size_ = 0;
  std::byte* file_ = nullptr;
};
std::vector<std::unique_ptr<FakeImport>> fake_imports;  ///< live objects
std::set<FakeStream*> fake_streams;                     ///< live objects
std::set<FakeEvent*> fake_events;                       ///< live objects
FakeStream& of(CuStream stream) { return *reinterpret_cast<FakeStream*>(stream); }
FakeEvent& of(CuEvent event) { return *reinterpret_cast<FakeEvent*>(event); }
void* hostOf(CuPointer memory) { return reinterpret_cast<void*>(static_cast<uintptr_t>(memory)); }

/// The result of a driver call: 0, or the failure that the test has requested.
int before(const char* call, bool needs_context = true) {
  FakeState& s = fake_state;
  if (needs_context && fake_depth == 0) ++s.calls_without;
  if (s.fail_nth > 0 && s.fail_call == call) {
    if (--s.fail_nth > 0) return 0;
    if (s.lasts) s.fail_nth = 1;
    s.unsure = s.unsure || s.fail_result != kCuOutOfMemory || s.fail_call == "eventRecord" ||
               s.fail_call == "eventSynchronize";
    return s.fail_result;
  }
  return 0;
}

template <class Handle>
Handle thing(int number) {
  return reinterpret_cast<Handle>(&fake_things[number]);
}

DriverTable makeTable() {
  DriverTable t;
  t.init = [](unsigned) {
    // If this is loaded as a shared library, no test has called beginFake() before.
    if (!fake_host) beginFake();
    return before("init", false);
  };
  t.driverGetVersion = [](int* version) {
    *version = 13000;
    return before("driverGetVersion", false);
  };
  t.getErrorString = [](CuResult result, const char** text) {
    *text = result == kCuOutOfMemory ? "out of memory" : "a failure";
    return kCuSuccess;
  };
  t.deviceGetCount = [](int* count) {
    *count = fake_state.devices;
    return before("deviceGetCount", false);
  };
  t.deviceGet = [](CuDevice* device, int number) {
    *device = number;
    return before("deviceGet", false);
  };
  t.deviceGetName = [](char* name, int size, CuDevice) {
    std::strncpy(name, "a GPU that pretends", static_cast<size_t>(size));
    return before("deviceGetName", false);
  };
  t.deviceGetAttribute = [](int* value, int attribute, CuDevice) {
    const FakeState& s = fake_state;
    *value = attribute == kCuCapabilityMajor   ? s.capability_major
             : attribute == kCuCapabilityMinor ? s.capability_minor
             : attribute == kCuMemoryPools     ? s.memory_pools
             : attribute == kCuClock           ? 1'000'000
                                               : 2;
    return before("deviceGetAttribute", false);
  };
  t.deviceTotalMem = [](size_t* bytes, CuDevice) {
    *bytes = size_t{8} << 30;
    return before("deviceTotalMem", false);
  };
  t.deviceGetUuid = [](CuId* id, CuDevice) {
    std::copy(fake_state.id.begin(), fake_state.id.end(), id->bytes);
    return before("deviceGetUuid", false);
  };
  t.ctxCreate = [](CuContext* context, unsigned, CuDevice) {
    if (const int result = before("ctxCreate", false)) return result;
    *context = thing<CuContext>(0);
    ++fake_state.contexts;
    ++fake_depth;
    return kCuSuccess;
  };
  t.ctxDestroy = [](CuContext) {
    --fake_state.contexts;
    return before("ctxDestroy", false);
  };
  t.ctxGetDevice = [](CuDevice* device) {
    *device = 0;
    return before("ctxGetDevice");
  };
  t.ctxPushCurrent = [](CuContext) {
    if (const int result = before("ctxPushCurrent", false)) return result;
    ++fake_depth;
    return kCuSuccess;
  };
  t.ctxPopCurrent = [](CuContext* context) {
    *context = thing<CuContext>(0);
    --fake_depth;
    return kCuSuccess;
  };
  t.moduleLoadData = [](CuModule* module, const void*) {
    if (const int result = before("moduleLoadData")) return result;
    *module = thing<CuModule>(1);
    ++fake_state.modules;
    return kCuSuccess;
  };
  t.moduleUnload = [](CuModule) {
    --fake_state.modules;
    return before("moduleUnload");
  };
  t.moduleGetFunction = [](CuFunction* function, CuModule, const char* name) {
    if (const int result = before("moduleGetFunction")) return result;
    static constexpr const char* kNames[] = {
#define SGM_CUDA_KERNEL(Name) "sgm" #Name,
        SGM_CUDA_KERNELS
#undef SGM_CUDA_KERNEL
    };
    for (size_t k = 0; k < std::size(kNames); ++k) {
      if (std::strcmp(name, kNames[k]) == 0) *function = reinterpret_cast<CuFunction>(&fake_function[k]);
    }
    return kCuSuccess;
  };
  t.streamCreate = [](CuStream* stream, unsigned) {
    if (const int result = before("streamCreate")) return result;
    auto* const made = new FakeStream;
    fake_streams.insert(made);
    *stream = reinterpret_cast<CuStream>(made);
    ++fake_state.streams;
    return kCuSuccess;
  };
  t.streamDestroy = [](CuStream stream) {
    // A GPU finishes submitted work, even if the stream is destroyed.
    of(stream).finish(of(stream).given);
    fake_streams.erase(&of(stream));
    delete &of(stream);
    --fake_state.streams;
    return before("streamDestroy");
  };
  t.streamGetCtx = [](CuStream, CuContext* context) {
    *context = thing<CuContext>(0);
    return before("streamGetCtx");
  };
  t.eventCreate = [](CuEvent* event, unsigned) {
    if (const int result = before("eventCreate")) return result;
    auto* const made = new FakeEvent;
    fake_events.insert(made);
    *event = reinterpret_cast<CuEvent>(made);
    ++fake_state.events;
    return kCuSuccess;
  };
  t.eventDestroy = [](CuEvent event) {
    fake_events.erase(&of(event));
    delete &of(event);
    --fake_state.events;
    return before("eventDestroy");
  };
  t.eventRecord = [](CuEvent event, CuStream stream) {
    if (const int result = before("eventRecord")) return result;
    of(event) = {&of(stream), of(stream).given, false};
    return kCuSuccess;
  };
  t.eventQuery = [](CuEvent event) {
    if (const int result = before("eventQuery")) return result;
    FakeEvent& e = of(event);
    if (e.stream == nullptr) return kCuSuccess;
    if (e.stream->done() < e.after && !std::exchange(e.asked, true)) return kCuNotReady;
    e.stream->finish(e.after);
    return kCuSuccess;
  };
  t.eventSynchronize = [](CuEvent event) {
    // If the driver's call fails, it has not waited for the event.
    if (const int result = before("eventSynchronize")) return result;
    if (of(event).stream != nullptr) of(event).stream->finish(of(event).after);
    return kCuSuccess;
  };
  t.memPoolCreate = [](CuPool* pool, const CuPoolProperties*) {
    if (const int result = before("memPoolCreate")) return result;
    *pool = thing<CuPool>(2);
    ++fake_state.pools;
    return kCuSuccess;
  };
  t.memPoolSetAttribute = [](CuPool, int, void*) { return before("memPoolSetAttribute"); };
  t.memPoolDestroy = [](CuPool) {
    --fake_state.pools;
    return before("memPoolDestroy");
  };
  t.memAllocFromPoolAsync = [](CuPointer* memory, size_t bytes, CuPool, CuStream) {
    if (const int result = before("memAllocFromPoolAsync")) return result;
    void* const block = std::aligned_alloc(256, (bytes + 255) / 256 * 256);
    std::memset(block, 0xCD, bytes);
    *memory = reinterpret_cast<uintptr_t>(block);
    fake_blocks.insert(block);
    ++fake_state.device_blocks;
    return kCuSuccess;
  };
  t.memFreeAsync = [](CuPointer memory, CuStream stream) {
    of(stream).give([memory] {
      fake_blocks.erase(hostOf(memory));
      std::free(hostOf(memory));
    });
    // If no other work is queued, the memory is freed at once, so that a memory checker detects a later use by another
    // stream.
    if (of(stream).queued.size() == 1) of(stream).finish(of(stream).given);
    --fake_state.device_blocks;
    return before("memFreeAsync");
  };
  t.importExternalMemory = [](CuImported* imported, const CuSharedMemory* memory) {
    if (const int result = before("importExternalMemory")) return result;
    auto made = std::make_unique<FakeImport>(memory->handle.descriptor, memory->bytes);
    if (memory->type != 1 || made->begin() == nullptr) return 1;
    close(memory->handle.descriptor);
    ++fake_state.imports;
    fake_imports.push_back(std::move(made));
    *imported = reinterpret_cast<CuImported>(fake_imports.back().get());
    return kCuSuccess;
  };
  t.externalMemoryGetMappedBuffer = [](CuPointer* memory, CuImported imported, const CuSharedRange* range) {
    if (const int result = before("externalMemoryGetMappedBuffer")) return result;
    FakeImport& import = *reinterpret_cast<FakeImport*>(imported);
    if (range->offset != 0 || range->bytes != import.bytes()) return 1;
    ++fake_state.mapped;
    *memory = reinterpret_cast<uintptr_t>(import.begin());
    return kCuSuccess;
  };
  t.memFree = [](CuPointer) {
    --fake_state.mapped;
    return before("memFree");
  };
  t.destroyExternalMemory = [](CuImported imported) {
    std::erase_if(fake_imports, [imported](const auto& one) { return one.get() == reinterpret_cast<void*>(imported); });
    --fake_state.imports;
    return before("destroyExternalMemory");
  };
  t.memHostAlloc = [](void** memory, size_t bytes, unsigned) {
    if (const int result = before("memHostAlloc")) return result;
    *memory = std::aligned_alloc(256, (bytes + 255) / 256 * 256);
    std::memset(*memory, 0xCD, bytes);
    fake_blocks.insert(*memory);
    ++fake_state.pinned_blocks;
    return kCuSuccess;
  };
  t.memFreeHost = [](void* memory) {
    fake_blocks.erase(memory);
    std::free(memory);
    --fake_state.pinned_blocks;
    return before("memFreeHost");
  };
  t.memcpyHtoDAsync = [](CuPointer to, const void* from, size_t bytes, CuStream stream) {
    if (const int result = before("memcpyHtoDAsync")) return result;
    of(stream).give([=] { std::memcpy(hostOf(to), from, bytes); });
    return kCuSuccess;
  };
  t.memcpyDtoHAsync = [](void* to, CuPointer from, size_t bytes, CuStream stream) {
    if (const int result = before("memcpyDtoHAsync")) return result;
    // Until the copy is executed, the destination has meaningless bytes.
    std::memset(to, 0xCD, bytes);
    of(stream).give([=] { std::memcpy(to, hostOf(from), bytes); });
    return kCuSuccess;
  };
  t.memcpyDtoDAsync = [](CuPointer to, CuPointer from, size_t bytes, CuStream stream) {
    if (const int result = before("memcpyDtoDAsync")) return result;
    of(stream).give([=] { std::memcpy(hostOf(to), hostOf(from), bytes); });
    return kCuSuccess;
  };
  t.memsetD8Async = [](CuPointer at, unsigned char value, size_t bytes, CuStream stream) {
    if (const int result = before("memsetD8Async")) return result;
    of(stream).give([=] { std::memset(hostOf(at), value, bytes); });
    return kCuSuccess;
  };
  t.launchKernel = [](CuFunction function, unsigned blocks, unsigned, unsigned, unsigned threads, unsigned, unsigned,
                      unsigned, CuStream stream, void** parameters, void**) {
    if (const int result = before("launchKernel")) return result;
    if (threads == 0 || threads > 1024 || blocks == 0) return 1;
    ++fake_state.launches;
    fake_state.launched_on = stream;
    const auto kernel = static_cast<Kernel>(reinterpret_cast<const char*>(function) - fake_function);
    const Batch batch = *static_cast<const Batch*>(parameters[0]);
    of(stream).give([=] { static_cast<void>(fake_runs->launch(kernel, blocks, batch)); });
    return kCuSuccess;
  };
  return t;
}

/// Serializes calls, because any thread may call a driver.
template <class Entry>
struct OneAtATime;
template <class... Arguments>
struct OneAtATime<CuResult (*DriverTable::*)(Arguments...)> {
  template <CuResult (*DriverTable::*entry)(Arguments...)>
  static CuResult call(Arguments... arguments) {
    static const DriverTable table = makeTable();
    const std::scoped_lock lock(fake_mutex);
    return (table.*entry)(arguments...);
  }
};

}  // namespace

FakeState& fakeState() { return fake_state; }

int fakeDepth() { return fake_depth; }

DriverTable fakeTable() {
  DriverTable table;
#define SGM_CU(entry, name, parameters) \
  table.entry = OneAtATime<decltype(&DriverTable::entry)>::call<&DriverTable::entry>;
  SGM_CU_FUNCTIONS
#undef SGM_CU
  return table;
}

void beginFake() {
  const auto id = fake_state.id;
  fake_state = {};
  fake_state.id = id;
  fake_host = makeHostDevice();
  fake_runs = *fake_host->makeStream();
}

void endFake() {
  for (FakeStream* stream : std::exchange(fake_streams, {})) delete stream;
  for (FakeEvent* event : std::exchange(fake_events, {})) delete event;
  for (void* block : std::exchange(fake_blocks, {})) std::free(block);
  fake_imports.clear();
  fake_runs.reset();
  fake_host.reset();
}

}  // namespace sgm::cuda
