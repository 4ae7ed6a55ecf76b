#pragma once
// Receives the bodies of requests: uploads into a file, short texts into memory.

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

/// The number of bytes of all bodies of one kind that are being received, and its limit. Bytes are counted, not
/// requests, so that a slow client cannot block others.
struct IncomingRoom {
  std::atomic<uint64_t> taken{0};
  uint64_t most = 0;
};

/// The bytes that one body has added to an IncomingRoom; the destructor subtracts them. Move-only.
class IncomingShare {
 public:
  explicit IncomingShare(std::shared_ptr<IncomingRoom> room) : room_(std::move(room)) {}
  IncomingShare(IncomingShare&& other) noexcept
      : room_(std::move(other.room_)), taken_(std::exchange(other.taken_, 0)) {}
  IncomingShare& operator=(IncomingShare&&) = delete;
  ~IncomingShare() {
    if (room_ != nullptr) room_->taken -= taken_;
  }

  /// Adds bytes. If that would exceed the limit, returns the answer to send.
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

/// Receives a text into memory.
class TextBody final : public http::Body {
 public:
  explicit TextBody(std::shared_ptr<IncomingRoom> room) : share_(std::move(room)) {}

  std::optional<http::Response> take(std::string_view piece) override;
  std::string release() && { return std::move(text_); }
  /// The text's share of the limit; must be kept as long as the text.
  IncomingShare releaseShare() && { return std::move(share_); }

 private:
  std::string text_;
  IncomingShare share_;
};

}  // namespace sgm::service
