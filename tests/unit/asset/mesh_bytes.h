#pragma once
// Makes the bytes of mesh files for tests, and describes the readers' results.

#include <cstring>
#include <string>
#include <utility>

#include "asset/read/mesh_file.h"
#include "catch.h"

namespace sgm::asset {

inline std::span<const std::byte> bytesOf(const std::string& file) { return std::as_bytes(std::span(file)); }

inline TriangleMesh meshIn(const std::string& file, MeshFileKind kind) {
  auto mesh = readMesh(bytesOf(file), kind);
  INFO((mesh ? "" : mesh.error().message));
  REQUIRE(mesh);
  return std::move(*mesh);
}

/// The message with which a file is rejected, without the advice after its last semicolon; empty if the file is valid.
inline std::string refusalOf(const std::string& file, MeshFileKind kind, const MeshLimits& limits = {}) {
  const auto mesh = readMesh(bytesOf(file), kind, limits);
  if (mesh) return "";
  const std::string& message = mesh.error().message;
  const size_t advice = message.rfind("; ");
  CHECK(advice != std::string::npos);
  if (mesh.error().code != Code::limit)
    CHECK(message.substr(advice + 2) == meshFileAdvice(meshFileKind(bytesOf(file)).value_or(kind)));
  if (mesh.error().line != 0)
    CHECK(message.substr(0, advice).ends_with(", at line " + std::to_string(mesh.error().line)));
  return message.substr(0, advice);
}

/// Appends the bytes of a number in this machine's byte order, or in reversed order if `turned`.
template <class T>
void putNumber(std::string& out, T value, bool turned = false) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  for (size_t i = 0; i < sizeof value; ++i) out += bytes[turned ? sizeof value - 1 - i : i];
}

inline std::string replacedIn(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  INFO(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace sgm::asset
