#pragma once
// The HTTP port for users and programs: the page, uploads, reports, reference histograms.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "tools/service/http/handler.h"
#include "tools/service/judge/inspector.h"
#include "tools/service/judge/masters.h"
#include "tools/service/judge/reports.h"
#include "tools/service/judge/request_bodies.h"
#include "tools/service/ports/access.h"
#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

struct WorkSettings {
  std::string upload_folder;  ///< empty: the system's folder for temporary files
  uint64_t max_upload_bytes = uint64_t{64} << 20;
  bool masters_writable = false;
  /// Limit of all uploads that are being received; a single upload is always accepted.
  uint64_t max_incoming_bytes = uint64_t{1} << 30;
};

/// Objects that the port uses; they must outlive the server.
struct WorkParts {
  const Access& access;
  Inspector& inspector;
  Masters& masters;
  Reports& reports;
  WatchedWorlds& worlds;
  std::function<ServiceState()> state;
};

class Work final : public http::Handler {
 public:
  Work(const WorkParts& parts, const WorkSettings& settings);

  http::Admission admit(const http::Request& request) override;
  void answer(const http::Request& request, std::unique_ptr<http::Body> body, http::Reply reply) override;

 private:
  http::Admission admitUpload(const http::Request& request);
  http::Admission admitMasters(const http::Request& request);
  void judge(const http::Request& request, std::unique_ptr<http::Body> body, http::Reply reply);

  WorkParts parts_;
  WorkSettings settings_;
  std::shared_ptr<IncomingRoom> room_, text_room_;  ///< bytes being received: uploads on disk, and texts in memory
  /// The embedded files by name, one copy for all clients.
  std::map<std::string_view, std::shared_ptr<const std::string>> files_;
};

}  // namespace sgm::service
