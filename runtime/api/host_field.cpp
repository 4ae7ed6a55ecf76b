#include "api/host_field.h"

#include <cstring>
#include <string>

#include "api/barrier.h"

namespace sgm::api {

namespace {

constexpr size_t kMaxHosts = 16;
constexpr float kSteepest = 1000;

sgm_result check(sgm_error* error, const sgm_host_field& host, const Program& program, const std::string& name) {
  if (sgm_result r = checkDesc(error, &host, name.c_str()); r != SGM_OK) return r;
  const auto wrong = [&](const char* what) { return fail(error, SGM_ERR_INVALID_ARGUMENT, name + what); };
  if (host.sample == nullptr) return wrong(".sample is NULL");
  for (int axis = 0; axis < 3; ++axis) {
    if (host.minimum[axis] > host.maximum[axis]) return wrong(".minimum is above .maximum");
  }
  if (!(host.steepness >= 0 && host.steepness <= kSteepest)) return wrong(".steepness is not between 0 and 1000");
  if ((host.flags & ~static_cast<uint32_t>(SGM_HOST_CUT)) != 0)
    return wrong(".flags has unknown bits: pass 0 or values of sgm_host_flag");
  if (host.material >= program.materials.size()) return wrong(".material is not declared in the grammar");
  if (host.tag >= program.tags.size()) return wrong(".tag is not declared in the grammar");
  if (host.smooth < 0 || host.smooth > kWidestHostBlend) return wrong(".smooth is not between 0 and 16,384 units");
  return SGM_OK;
}

/// Converts the result of the caller's sample function to an internal code. Whatever the code, the library does not
/// retry the call.
Code codeOf(sgm_result result) {
  switch (result) {
    case SGM_ERR_INVALID_ARGUMENT:
      return Code::invalid_argument;
    case SGM_ERR_LIMIT:
      return Code::limit;
    case SGM_ERR_RANGE:
      return Code::range;
    case SGM_ERR_IO:
      return Code::io;
    default:
      return Code::unsupported;
  }
}

Result<void> sampleHost(sgm_host_sample sample, void* user, const SampleLattice& at, std::span<float> values) {
  const sgm_host_lattice lattice{
      {at.origin.x, at.origin.y, at.origin.z}, at.spacing, {at.count[0], at.count[1], at.count[2]}};
  const sgm_result result = sample(user, &lattice, values.data());
  if (result != SGM_OK) {
    return Error{codeOf(result), std::string("the host's field could not be sampled at ") +
                                     std::to_string(lattice.origin[0]) + ", " + std::to_string(lattice.origin[1]) +
                                     ", " + std::to_string(lattice.origin[2]) + " units: its callback returned " +
                                     sgm_result_name(result)};
  }
  for (float& value : values) value *= SGM_UNITS_PER_METRE;
  return {};
}

}  // namespace

sgm_result takeHosts(sgm_error* error, const sgm_field_desc& desc, const Program& program,
                     std::vector<HostField>& hosts) {
  if (desc.host_count == 0) return SGM_OK;
  if (desc.hosts == nullptr) return nullArgument(error, "desc.hosts");
  if (desc.host_count > kMaxHosts)
    return fail(error, SGM_ERR_LIMIT, "desc.host_count is more than " + std::to_string(kMaxHosts));
  size_t stride = desc.host_stride;
  if (sgm_result r = checkStride<sgm_host_field>(error, stride, "desc.host_stride"); r != SGM_OK) return r;
  for (size_t i = 0; i < desc.host_count; ++i) {
    sgm_host_field host;
    std::memcpy(&host, reinterpret_cast<const char*>(desc.hosts) + i * stride, sizeof host);
    if (sgm_result r = check(error, host, program, "desc.hosts[" + std::to_string(i) + "]"); r != SGM_OK) return r;
    HostField field;
    field.sample = [sample = host.sample, user = host.user](const SampleLattice& at, std::span<float> values) {
      return sampleHost(sample, user, at, values);
    };
    field.identity = host.identity;
    field.bounds = {{host.minimum[0], host.minimum[1], host.minimum[2]},
                    {host.maximum[0], host.maximum[1], host.maximum[2]}};
    field.cut = (host.flags & SGM_HOST_CUT) != 0;
    field.label = makeLabel(host.material, host.tag);
    field.smooth = host.smooth;
    field.steepness = host.steepness;
    hosts.push_back(std::move(field));
  }
  return SGM_OK;
}

}  // namespace sgm::api
