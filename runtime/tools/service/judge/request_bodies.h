#pragma once
// Receives the bodies of requests: uploads into files, short texts into memory.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tools/service/http/handler.h"
#include "tools/service/judge/upload.h"

namespace sgm::service {

/// Total number of bytes of all bodies of one kind that are being received, and its limit. Bytes are limited instead of
/// requests, so that slow clients do not block others.
struct IncomingRoom {
  std::atomic<uint64_t> taken{0};
  uint64_t most = 0;
};

/// The bytes of an IncomingRoom that one body uses. The destructor gives these bytes back. Move-only.
class IncomingShare {
 public:
  explicit IncomingShare(std::shared_ptr<IncomingRoom> room) : room_(std::move(room)) {}
  IncomingShare(IncomingShare&& other) noexcept
      : room_(std::move(other.room_)), taken_(std::exchange(other.taken_, 0)) {}
  IncomingShare& operator=(IncomingShare&&) = delete;
  ~IncomingShare() {
    if (room_ != nullptr) room_->taken -= taken_;
  }

  /// Adds bytes to the share. If the room's limit would be exceeded, returns the answer to send instead.
  std::optional<http::Response> grow(size_t bytes);

 private:
  std::shared_ptr<IncomingRoom> room_;
  uint64_t taken_ = 0;
};

class UploadBody final : public http::Body {
 public:
  UploadBody(Upload upload, std::shared_ptr<IncomingRoom> room) : upload_(std::move(upload)), share_(std::move(room)) {}

  std::optional<http::Response> take(std::string_view piece) override;
  Upload release() && { return std::move(upload_); }

 private:
  Upload upload_;
  IncomingShare share_;
};

/// Receives a body as text in memory.
class TextBody final : public http::Body {
 public:
  explicit TextBody(std::shared_ptr<IncomingRoom> room) : share_(std::move(room)) {}

  std::optional<http::Response> take(std::string_view piece) override;
  std::string release() && { return std::move(text_); }
  /// Returns the text's share of the limit for texts in memory. The caller must keep the share as long as the text.
  IncomingShare releaseShare() && { return std::move(share_); }

 private:
  std::string text_;
  IncomingShare share_;
};

}  // namespace sgm::service
