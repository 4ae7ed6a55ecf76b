#pragma once
// Converts a host's fields to the library's.

#include <vector>

#include "field/host_field.h"
#include "grammar/syntax/program.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Reads the descriptor's fields. Returns SGM_OK, or the problem of one of them. Throws std::bad_alloc.
sgm_result takeHosts(sgm_error* error, const sgm_field_desc& desc, const Program& program,
                     std::vector<HostField>& hosts);

}  // namespace sgm::api
