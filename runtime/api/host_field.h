#pragma once
// Converts the host fields (fields that the engine samples) of the C interface to internal objects.

#include <vector>

#include "field/host_field.h"
#include "grammar/syntax/program.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Checks and converts the host fields of a descriptor. Returns SGM_OK, or the error of the first invalid host field.
/// Throws std::bad_alloc.
sgm_result takeHosts(sgm_error* error, const sgm_field_desc& desc, const Program& program,
                     std::vector<HostField>& hosts);

}  // namespace sgm::api
