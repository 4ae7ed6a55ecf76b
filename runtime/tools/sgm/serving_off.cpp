// Replaces the metrics service in a build without it (SGM_TOOLS=core): starting it is an error.

#include "tools/support/serving.h"

namespace sgm::cli {

void Serving::Stop::operator()(sgm_service*) const {}

Result<Serving> Serving::start(const ServingOptions&) {
  return Error{
      Code::unsupported,
      "this build of sgm has no metrics service: configure it with SGM_TOOLS=all (cmake --preset release), and "
      "build it again"};
}

Result<void> Serving::watch(const std::string&, sgm_world*) { return {}; }

}  // namespace sgm::cli
