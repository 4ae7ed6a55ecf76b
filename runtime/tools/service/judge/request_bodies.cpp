#include "tools/service/judge/request_bodies.h"

namespace sgm::service {

std::optional<http::Response> IncomingShare::grow(size_t bytes) {
  taken_ += bytes;
  if ((room_->taken += bytes) <= room_->most) return std::nullopt;
  http::Response response =
      makeResponse(http::Problem{503, "too_many_uploads", "too many bytes are being uploaded: try again soon", ""});
  response.fields.push_back({"Retry-After", "5"});
  return response;
}

std::optional<http::Response> UploadBody::take(std::string_view piece) {
  if (std::optional<http::Response> full = share_.grow(piece.size())) return full;
  const Result<void> written = upload_.append(piece);
  if (written) return std::nullopt;
  return makeResponse(http::Problem{507, "no_room", "the upload cannot be stored: " + written.error().message, ""});
}

std::optional<http::Response> TextBody::take(std::string_view piece) {
  if (std::optional<http::Response> full = share_.grow(piece.size())) return full;
  text_ += piece;
  return std::nullopt;
}

}  // namespace sgm::service
