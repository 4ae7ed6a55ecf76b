// Implements the C interface in sgm_service.h by calling the C++ class Service.

#include <sgm/sgm_service.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "tools/service/service.h"

struct sgm_service {
  std::unique_ptr<sgm::service::Service> service;
};

namespace sgm::service {
namespace {

constexpr uint64_t kMaxUploadBytes = uint64_t{1} << 32;
constexpr uint32_t kMaxJobs = 64, kMaxWaiting = 4096;

sgm_result resultOf(Code code) {
  switch (code) {
    case Code::invalid_argument:
      return SGM_ERR_INVALID_ARGUMENT;
    case Code::range:
      return SGM_ERR_RANGE;
    case Code::bad_input:
      return SGM_ERR_DATA;
    case Code::limit:
      return SGM_ERR_LIMIT;
    case Code::out_of_memory:
      return SGM_ERR_OUT_OF_MEMORY;
    case Code::io:
      return SGM_ERR_IO;
    case Code::unsupported:
      return SGM_ERR_UNSUPPORTED;
    case Code::cancelled:
      return SGM_ERR_CANCELLED;
    case Code::busy:
      return SGM_ERR_BUSY;
    case Code::device_lost:
      return SGM_ERR_DEVICE_LOST;
  }
  return SGM_ERR_INTERNAL;
}

sgm_result fail(sgm_error* out, sgm_result code, std::string_view message) {
  if (out != nullptr) {
    *out = SGM_ERROR_INIT;
    out->code = code;
    size_t size = std::min<size_t>(message.size(), SGM_MESSAGE_SIZE - 1);
    // Cut a long message between UTF-8 characters, not within one.
    while (size < message.size() && size > 0 && (static_cast<unsigned char>(message[size]) & 0xC0u) == 0x80u) --size;
    std::memcpy(out->message, message.data(), size);
  }
  return code;
}

/// Runs the body of a C function and turns each exception into a result code, since no exception may leave the library.
template <class Work>
sgm_result guarded(sgm_error* error, const Work& work) {
  try {
    const Result<void> done = work();
    return done ? SGM_OK : fail(error, resultOf(done.error().code), done.error().message);
  } catch (const std::bad_alloc&) {
    return fail(error, SGM_ERR_OUT_OF_MEMORY, "the service is out of memory");
  } catch (const std::exception& e) {
    return fail(error, SGM_ERR_INTERNAL, e.what());
  }
}

Error wrong(std::string message) { return {Code::invalid_argument, std::move(message)}; }

std::string textOr(const char* text, const char* otherwise) { return text != nullptr ? text : otherwise; }

Result<ServiceSettings> settingsOf(const sgm_service_desc& desc) {
  ServiceSettings settings;
  settings.access.address = textOr(desc.address, "127.0.0.1");
  // Reject an empty token: it may come from an empty file, and must not switch off access control.
  if (desc.token != nullptr && *desc.token == '\0') return wrong("desc.token is empty: use NULL to require no token");
  settings.access.token = textOr(desc.token, "");
  if (desc.host_name_count > 0 && desc.host_names == nullptr)
    return wrong("desc.host_names is NULL, but desc.host_name_count is not 0");
  for (size_t i = 0; i < desc.host_name_count; ++i) {
    if (desc.host_names[i] == nullptr) return wrong("desc.host_names has a NULL");
    settings.access.host_names.emplace_back(desc.host_names[i]);
  }
  settings.work_port = desc.work_port;
  settings.operations_port = desc.operations_port;
  if (desc.work_port != 0 && desc.work_port == desc.operations_port)
    return wrong("desc.work_port and desc.operations_port are equal: choose different ports");
  settings.work.upload_folder = textOr(desc.upload_folder, "");
  if (desc.upload_bytes > kMaxUploadBytes) return wrong("desc.upload_bytes is more than 2^32");
  if (desc.upload_bytes > 0) settings.work.max_upload_bytes = desc.upload_bytes;
  InspectorSettings& inspector = settings.inspector;
  inspector.program = textOr(desc.inspector, "");
  inspector.masters = textOr(desc.masters, "");
  if (desc.inspector_memory > 0) inspector.memory = desc.inspector_memory;
  if (desc.inspector_seconds > 0) inspector.time = std::chrono::seconds(desc.inspector_seconds);
  if (desc.inspector_jobs > kMaxJobs) return wrong("desc.inspector_jobs is more than 64");
  if (desc.inspector_jobs > 0) inspector.jobs = desc.inspector_jobs;
  if (desc.inspector_waiting > kMaxWaiting) return wrong("desc.inspector_waiting is more than 4,096");
  if (desc.inspector_waiting > 0) inspector.waiting = desc.inspector_waiting;
  return settings;
}

}  // namespace
}  // namespace sgm::service

using sgm::Result;
using sgm::service::fail;
using sgm::service::guarded;
using sgm::service::Service;
using sgm::service::wrong;

sgm_result sgm_service_start(const sgm_service_desc* desc, sgm_service** out, sgm_error* error) {
  if (out == nullptr) return fail(error, SGM_ERR_INVALID_ARGUMENT, "out is NULL");
  *out = nullptr;
  if (desc == nullptr) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc is NULL");
  if (desc->struct_size != sizeof(sgm_service_desc))
    return fail(error, SGM_ERR_STRUCT_SIZE,
                "desc.struct_size does not match this library: start from SGM_SERVICE_DESC_INIT");
  if (desc->next != nullptr)
    return fail(error, SGM_ERR_UNSUPPORTED, "desc.next is not NULL: this version has no extensions");
  if (desc->api_version != SGM_API_VERSION)
    return fail(error, SGM_ERR_VERSION,
                "the header and the library have different versions: rebuild with the header of this library");
  return guarded(error, [&]() -> Result<void> {
    const Result<sgm::service::ServiceSettings> settings = sgm::service::settingsOf(*desc);
    if (!settings) return settings.error();
    Result<std::unique_ptr<Service>> service = Service::start(*settings);
    if (!service) return service.error();
    *out = new sgm_service{std::move(*service)};
    return {};
  });
}

sgm_result sgm_service_get_ports(const sgm_service* service, uint16_t* work_port, uint16_t* operations_port,
                                 sgm_error* error) {
  if (service == nullptr) return fail(error, SGM_ERR_INVALID_ARGUMENT, "service is NULL");
  if (work_port != nullptr) *work_port = service->service->workPort();
  if (operations_port != nullptr) *operations_port = service->service->operationsPort();
  return SGM_OK;
}

sgm_result sgm_service_watch_world(sgm_service* service, const char* name, sgm_world* world, sgm_error* error) {
  return guarded(error, [&]() -> Result<void> {
    if (service == nullptr || name == nullptr || world == nullptr) return wrong("service, name or world is NULL");
    return service->service->worlds().watch(name, world);
  });
}

sgm_result sgm_service_forget_world(sgm_service* service, sgm_world* world, sgm_error* error) {
  return guarded(error, [&]() -> Result<void> {
    if (service == nullptr || world == nullptr) return wrong("service or world is NULL");
    service->service->worlds().forget(world);
    return {};
  });
}

sgm_result sgm_service_stop(sgm_service* service, uint32_t grace_milliseconds) {
  if (service == nullptr) return SGM_OK;
  return guarded(nullptr, [&]() -> Result<void> {
    const std::unique_ptr<sgm_service> ending(service);
    ending->service->stop(std::chrono::milliseconds(grace_milliseconds));
    return {};
  });
}
