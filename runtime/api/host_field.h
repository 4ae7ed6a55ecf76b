#pragma once
// Converts the host fields of the C interface to internal ones.

#include <vector>

#include "field/host_field.h"
#include "grammar/syntax/program.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Converts the descriptor's host fields. Returns SGM_OK, or the problem of one of them. Throws std::bad_alloc.
sgm_result takeHosts(sgm_error* error, const sgm_field_desc& desc, const Program& program,
                     std::vector<HostField>& hosts);

}  // namespace sgm::api
