#pragma once
// Counter-based random numbers, so that all machines and threads draw the same numbers. Every random number is a pure
// function of a key, which is a hash of the derivation path, and an ordinal. No generator has a state.

#include <cstdint>
#include <string_view>

namespace sgm {

/// The finaliser of splitmix64 (Stafford's Mix13): a bijective hash of 64 bits in which every input bit affects all
/// output bits.
constexpr uint64_t mix64(uint64_t x) {
  x ^= x >> 30;
  x *= 0xBF58476D1CE4E5B9u;
  x ^= x >> 27;
  x *= 0x94D049BB133111EBu;
  x ^= x >> 31;
  return x;
}

constexpr uint64_t hashCombine(uint64_t a, uint64_t b) { return mix64(a * 0x9E3779B97F4A7C15u + mix64(b)); }

/// FNV-1a followed by mix64, for names and grammar text. The value is the same on every machine.
constexpr uint64_t hashText(std::string_view text) {
  uint64_t h = 0xCBF29CE484222325u;
  for (char c : text) h = (h ^ static_cast<uint8_t>(c)) * 0x100000001B3u;
  return mix64(h ^ text.size());
}

/// The hash of a derivation path: the key of random draws. child() returns the key of a child from its rule name and
/// ordinal; unit() returns a random number.
struct PathKey {
  uint64_t value = 0;

  constexpr PathKey child(uint64_t name, uint64_t ordinal) const {
    return {hashCombine(hashCombine(value, name), ordinal)};
  }
  /// Returns random number `ordinal` of this key, uniform in [0, 1) with 53 bits.
  constexpr double unit(uint64_t ordinal) const {
    return static_cast<double>(hashCombine(value, ordinal) >> 11) * 0x1p-53;
  }
  friend constexpr auto operator<=>(const PathKey&, const PathKey&) = default;
};

}  // namespace sgm
