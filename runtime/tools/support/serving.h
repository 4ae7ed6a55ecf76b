#pragma once
// Starts the metrics service for a command such as `fly`.

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
  std::string token_file;          ///< file whose first line is the token that clients must send; empty: no token
  std::vector<std::string> hosts;  ///< additional host names of this machine that clients may use
  std::string masters;             ///< file of reference histograms; empty: the built-in histograms
  std::string upload_folder;
  /// In MB: maximum size of an upload, and memory limit of the process that inspects it.
  uint64_t upload_mb = 64, memory_mb = 2048;
  uint32_t seconds = 60, jobs = 2, waiting = 16;
};

/// The metrics service that a command has started. Used by one thread only. Contract: watched worlds outlive it.
class Serving {
 public:
  /// Starts the service. Errors: io if the token file cannot be read or a port cannot be opened; invalid_argument;
  /// unsupported in a build without the service (serving_off.cpp).
  static Result<Serving> start(const ServingOptions& options);

  Result<void> watch(const std::string& name, sgm_world* world);
  /// URL of the users' port without a path, such as "http://127.0.0.1:8464".
  const std::string& work() const { return work_; }
  const std::string& operations() const { return operations_; }

 private:
  /// Time in which pending requests may still be answered when the service is stopped.
  static constexpr uint32_t kGraceMilliseconds = 5000;
  struct Stop {
    void operator()(sgm_service* service) const;
  };

  std::unique_ptr<sgm_service, Stop> service_;
  std::string work_, operations_;
};

}  // namespace sgm::cli
