#pragma once
// The HTTP port for users and programs: the web page, uploads, reports and reference histograms.

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
  std::string upload_folder;  ///< directory for uploads; if empty, the system's directory for temporary files
  uint64_t max_upload_bytes = uint64_t{64} << 20;
  bool masters_writable = false;
  /// Limit of the total size of all uploads that are being received; at least max_upload_bytes, so that a single upload
  /// always fits.
  uint64_t max_incoming_bytes = uint64_t{1} << 30;
};

/// The objects that the port uses. They must outlive the server.
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
  std::shared_ptr<IncomingRoom> room_, text_room_;  ///< bytes that are being received: uploads on disk (room_) and
                                                    ///< texts in memory (text_room_)
  /// The embedded files by name. All clients share one copy of each.
  std::map<std::string_view, std::shared_ptr<const std::string>> files_;
};

}  // namespace sgm::service
