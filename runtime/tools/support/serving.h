#pragma once
// The metrics service, as commands start it.

#include <sgm/sgm_service.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct ServingOptions {
  std::string listen = "127.0.0.1";
  uint16_t port = 8464, operations_port = 9464;
  std::string token_file;          ///< its first line is the token; empty: there is none
  std::vector<std::string> hosts;  ///< names of this machine
  std::string masters;             ///< file of reference histograms; empty: the built-in ones
  std::string upload_folder;
  uint64_t upload_mb = 64, memory_mb = 2048;  ///< for one upload, and to inspect it
  uint32_t seconds = 60, jobs = 2, waiting = 16;
};

/// Used by one thread. Watched worlds must outlive it.
class Serving {
 public:
  /// Errors: io for the token's file and the ports; invalid_argument; unsupported (serving_off.cpp).
  static Result<Serving> start(const ServingOptions& options);

  Result<void> watch(const std::string& name, sgm_world* world);
  /// "http://127.0.0.1:8464", without a path.
  const std::string& work() const { return work_; }
  const std::string& operations() const { return operations_; }

 private:
  /// At the end, pending requests may still be answered within this time.
  static constexpr uint32_t kGraceMilliseconds = 5000;
  struct Stop {
    void operator()(sgm_service* service) const;
  };

  std::unique_ptr<sgm_service, Stop> service_;
  std::string work_, operations_;
};

}  // namespace sgm::cli
