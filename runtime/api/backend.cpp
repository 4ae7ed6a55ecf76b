#include "backend/backend.h"

#include <cstring>
#include <string_view>

#include "api/backend_request.h"
#include "api/barrier.h"
#include "api/runtime.h"
#include "backend/open/open_backend.h"

namespace sgm::api {

namespace {

BackendRequest requestFor(BackendKind kind, bool automatic = false) {
  BackendRequest request;
  request.kind = kind;
  request.automatic = automatic;
  return request;
}

Result<std::shared_ptr<Backend>> makeFor(sgm_runtime& runtime, BackendRequest request) {
  if (request.kind == BackendKind::cuda && !request.automatic) request.external = runtime.devices.drawing;
  request.pipeline_folder = runtime.pipeline_folder;
  request.inform = [&runtime](const std::string& message) { runtime.log(SGM_LOG_INFO, message); };
  request.warn = [&runtime](const std::string& message) { runtime.log(SGM_LOG_WARNING, message); };
  Result<std::unique_ptr<Backend>> made = makeBackend(request, *runtime.jobs, &runtime.memory, runtime.profiler);
  if (!made) return made.error();
  return std::shared_ptr<Backend>(std::move(*made));
}

/// Creates the automatic backend for a runtime with an external Vulkan device that shares memory with CUDA. The choice
/// is CUDA if it can store meshes in the Vulkan device's memory; otherwise the Vulkan device if it is hardware, not a
/// software renderer; otherwise the CPU.
Result<std::shared_ptr<Backend>> createWithInterop(sgm_runtime& runtime) {
  Result<std::shared_ptr<Backend>> cuda = makeFor(runtime, requestFor(BackendKind::cuda));
  if (cuda) return cuda;
  runtime.log(SGM_LOG_INFO, "backend auto skips CUDA: " + cuda.error().message);
  const std::shared_ptr<Backend>& drawing = runtime.devices.vulkan;
  return drawing->capabilities().software ? makeFor(runtime, requestFor(BackendKind::cpu)) : drawing;
}

}  // namespace

std::optional<BackendRequest> requestOf(sgm_backend backend) {
  switch (backend) {
    case SGM_BACKEND_AUTO:
      return requestFor(BackendKind::cpu, true);
    case SGM_BACKEND_CPU:
      return requestFor(BackendKind::cpu);
    case SGM_BACKEND_VULKAN:
      return requestFor(BackendKind::vulkan);
    case SGM_BACKEND_CUDA:
      return requestFor(BackendKind::cuda);
    case SGM_BACKEND_FORCE_32_BIT:
      break;
  }
  return std::nullopt;
}

Result<std::shared_ptr<Backend>> backendFor(sgm_runtime& runtime, const BackendRequest& request) {
  DeviceBackends& shared = runtime.devices;
  const bool device = request.automatic || request.kind != BackendKind::cpu;
  const std::scoped_lock lock(shared.mutex);
  const BackendRequest wanted = request.automatic && shared.none ? BackendRequest{} : request;
  // A GPU should have only one CUDA context, so AUTO reuses the CUDA backend if it already exists.
  if (request.automatic && !shared.automatic && shared.cuda) shared.automatic = shared.cuda;
  std::shared_ptr<Backend>& kept = request.automatic                   ? shared.automatic
                                   : request.kind == BackendKind::cuda ? shared.cuda
                                                                       : shared.vulkan;
  if (device && kept) return kept;
  Result<std::shared_ptr<Backend>> made =
      wanted.automatic && shared.drawing ? createWithInterop(runtime) : makeFor(runtime, wanted);
  if (!made) return made.error();
  const std::shared_ptr<Backend> backend = std::move(*made);
  const bool on_cpu = backend->capabilities().kind == BackendKind::cpu;
  if (device && !on_cpu) kept = backend;
  // A GPU should have only one CUDA context, so a later request for CUDA by name reuses the backend that AUTO has
  // created.
  if (request.automatic && backend->capabilities().kind == BackendKind::cuda && !shared.cuda) shared.cuda = backend;
  shared.none = shared.none || (request.automatic && on_cpu);
  return backend;
}

namespace {

/// Releases a backend that was created only for a query, so that an external device can replace it. Error: busy if a
/// field uses the backend, or if the backend already runs on an external device.
Result<void> yieldTo(DeviceBackends& shared, BackendKind kind, std::shared_ptr<Backend>& named, bool external) {
  const auto isKind = [kind](const std::shared_ptr<Backend>& kept) {
    return kept && kept->capabilities().kind == kind;
  };
  for (std::shared_ptr<Backend>* kept : {&named, &shared.automatic}) {
    const long owners = named == shared.automatic ? 2 : 1;
    if (isKind(*kept) && kept->use_count() == owners && !external) kept->reset();
  }
  if (!isKind(named) && !isKind(shared.automatic)) return {};
  return Error{Code::busy,
               std::string("the runtime already has a ") + (kind == BackendKind::cuda ? "CUDA" : "Vulkan") +
                   " device, external or created for a field: lend one device, before the first field is created"};
}

}  // namespace

Result<void> lendVulkan(sgm_runtime& runtime, std::shared_ptr<const vulkan::BorrowedDevice> device,
                        bool shares_memory) {
  DeviceBackends& shared = runtime.devices;
  const std::scoped_lock lock(shared.mutex);
  if (Result<void> free = yieldTo(shared, BackendKind::vulkan, shared.vulkan, shared.external); !free) return free;
  if (shares_memory && !yieldTo(shared, BackendKind::cuda, shared.cuda, shared.external_context)) {
    return Error{Code::busy,
                 "the runtime already has a CUDA device, whose meshes would not stay on this Vulkan device: lend the "
                 "Vulkan device first"};
  }
  BackendRequest request = requestFor(BackendKind::vulkan);
  request.external = device;
  Result<std::shared_ptr<Backend>> made = makeFor(runtime, std::move(request));
  if (!made) return made.error();
  shared.vulkan = std::move(*made);
  shared.external = true;
  if (shares_memory) {
    shared.drawing = std::move(device);
    shared.none = false;
  } else if (!shared.vulkan->capabilities().software && !shared.automatic) {
    shared.automatic = shared.vulkan;
  }
  return {};
}

Result<void> lendCuda(sgm_runtime& runtime, std::shared_ptr<const cuda::BorrowedContext> context) {
  DeviceBackends& shared = runtime.devices;
  const std::scoped_lock lock(shared.mutex);
  if (Result<void> free = yieldTo(shared, BackendKind::cuda, shared.cuda, shared.external_context); !free) return free;
  BackendRequest request = requestFor(BackendKind::cuda);
  request.external_context = std::move(context);
  Result<std::shared_ptr<Backend>> made = makeFor(runtime, std::move(request));
  // device_lost is converted to unsupported: to callers, device_lost means that a device failed after the runtime used
  // it.
  if (!made)
    return made.error().code == Code::device_lost ? Error{Code::unsupported, made.error().message} : made.error();
  shared.cuda = std::move(*made);
  shared.external_context = true;
  // CUDA becomes the automatic choice. Exception: the automatic choice is already an external hardware Vulkan device
  // that does not share memory with CUDA.
  if (shared.drawing || !shared.external || shared.automatic != shared.vulkan) shared.automatic = shared.cuda;
  return {};
}

}  // namespace sgm::api

using namespace sgm::api;

namespace {

sgm_backend backendOf(sgm::BackendKind kind) {
  switch (kind) {
    case sgm::BackendKind::cpu:
      return SGM_BACKEND_CPU;
    case sgm::BackendKind::vulkan:
      return SGM_BACKEND_VULKAN;
    case sgm::BackendKind::cuda:
      return SGM_BACKEND_CUDA;
  }
  return SGM_BACKEND_AUTO;
}

void copyText(char (&to)[SGM_NAME_SIZE], std::string_view text) {
  const size_t length = text.size() < SGM_NAME_SIZE ? text.size() : SGM_NAME_SIZE - 1;
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

}  // namespace

void sgm::api::fillInfo(const sgm::Backend& backend, sgm_backend_info& info) {
  const sgm::BackendCapabilities& capabilities = backend.capabilities();
  const sgm::BackendCounters counters = backend.counters();
  info.backend = backendOf(capabilities.kind);
  info.usable = 1;
  info.exact = capabilities.exact ? 1 : 0;
  info.concurrency = capabilities.concurrency;
  info.chunks = counters.chunks;
  info.chunks_on_cpu = counters.on_cpu;
  info.losses = counters.device_lost;
  info.resident = counters.resident;
  copyText(info.name, sgm::backendName(capabilities.kind));
  copyText(info.device, capabilities.device);
  copyText(info.reason, "");
}

sgm_result sgm_backend_query(sgm_runtime* runtime, sgm_backend backend, sgm_backend_info* info, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, info, "info"); r != SGM_OK) return r;
    const std::optional<sgm::BackendRequest> request = requestOf(backend);
    if (!request) return fail(error, SGM_ERR_INVALID_ARGUMENT, "backend is not a valid sgm_backend");
    const sgm::Result<std::shared_ptr<sgm::Backend>> made = backendFor(*runtime, *request);
    if (!made && made.error().code != sgm::Code::unsupported) return fail(error, made.error());
    info->backend = backend;
    if (made) {
      fillInfo(**made, *info);
      return SGM_OK;
    }
    info->usable = info->exact = 0;
    info->concurrency = 0;
    info->chunks = info->chunks_on_cpu = info->losses = info->resident = 0;
    copyText(info->name, sgm::backendName(request->kind));
    copyText(info->device, "");
    copyText(info->reason, made.error().message);
    return SGM_OK;
  });
}
