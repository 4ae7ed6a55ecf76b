#pragma once
// A host's fields as the library's.

#include <vector>

#include "field/host_field.h"
#include "grammar/syntax/program.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// SGM_OK with the descriptor's fields, or what is wrong with one of them. Throws std::bad_alloc.
sgm_result takeHosts(sgm_error* error, const sgm_field_desc& desc, const Program& program,
                     std::vector<HostField>& hosts);

}  // namespace sgm::api
