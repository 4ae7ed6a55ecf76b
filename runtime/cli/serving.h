#pragma once
// The metrics service, as the command starts it.

#include <sgm/sgm_service.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct ServingOptions {
  std::string listen = "127.0.0.1";
  uint16_t port = 8464, operations_port = 9464;
  std::string token_file;          ///< its first line is the token; empty: there is none
  std::vector<std::string> hosts;  ///< names of this machine
  std::string masters;             ///< a base; empty: those that are built in
  std::string upload_folder;
  uint64_t upload_mb = 64, memory_mb = 2048;  ///< of one upload, and to inspect it
  uint32_t seconds = 60, jobs = 2, waiting = 16;
};

/// A name that a world can be watched by, as like to this text as can be.
std::string worldName(std::string_view text);

/// One thread. What it watches must outlive it.
class Serving {
 public:
  /// Errors: io for the token's file and the ports; invalid_argument.
  static Result<Serving> start(const ServingOptions& options);

  Result<void> watch(const std::string& name, sgm_world* world);
  /// "http://127.0.0.1:8464", without a path.
  const std::string& work() const { return work_; }
  const std::string& operations() const { return operations_; }

 private:
  /// What is asked at the end may still be answered within this time.
  static constexpr uint32_t kGraceMilliseconds = 5000;
  struct Stop {
    void operator()(sgm_service* service) const { static_cast<void>(sgm_service_stop(service, kGraceMilliseconds)); }
  };

  std::unique_ptr<sgm_service, Stop> service_;
  std::string work_, operations_;
};

/// Holds SIGINT, SIGTERM and SIGHUP back, from this thread and those that it starts, until it is waited for one.
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  /// Whether one has come. Never waits.
  bool came();
  /// Ends the process by the signal that has come, as if it had never been held back.
  void pass();
  /// Blocks until one comes, unless one has. The next one ends the process.
  void wait();

 private:
  void release();

  bool held_ = true;
  int came_ = 0;  ///< the signal
};

}  // namespace sgm::cli
