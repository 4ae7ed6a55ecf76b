#pragma once
// Serialises numbers to little-endian bytes and deserialises them; the byte order is the same on every supported
// machine.

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace sgm {

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    const size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }

 private:
  std::vector<std::byte>& bytes_;
};

/// Deserialises numbers from bytes, one after another; does not own the bytes. Reading past the end returns 0, and
/// failed() is true from then on.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    T value{};
    if (sizeof value > bytes_.size()) {
      failed_ = true;
      bytes_ = {};
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }

  bool failed() const { return failed_; }
  size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace sgm
