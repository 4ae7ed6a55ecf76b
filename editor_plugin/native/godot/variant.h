#pragma once
// Values of the engine. All values except plain numbers and vectors are Variants, and methods are called by name. This
// is slower than typed calls, but the plugin makes no call so often that it matters, and names stay the same from
// version to version.

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interface.h"
#include "vectors.h"

namespace sgm_godot {

using Object = GDExtensionObjectPtr;

/// A StringName of the engine: a name that is interned once, and then compared as a pointer.
class Name {
 public:
  explicit Name(std::string_view text);
  ~Name();
  Name(const Name&) = delete;
  Name& operator=(const Name&) = delete;
  const void* get() const { return bytes_; }
  void* get() { return bytes_; }

 private:
  alignas(8) unsigned char bytes_[8];
};

/// `value`: the engine's number of the type that has the layout of T. The table below lists them.
template <class T>
struct VariantType;
#define SGM_GODOT_TYPE(T, TYPE)                                   \
  template <>                                                     \
  struct VariantType<T> {                                         \
    static constexpr int value = GDEXTENSION_VARIANT_TYPE_##TYPE; \
  };
SGM_GODOT_TYPE(bool, BOOL)
SGM_GODOT_TYPE(int64_t, INT)
SGM_GODOT_TYPE(double, FLOAT)
SGM_GODOT_TYPE(Vector2, VECTOR2)
SGM_GODOT_TYPE(Vector3, VECTOR3)
SGM_GODOT_TYPE(Vector3i, VECTOR3I)
SGM_GODOT_TYPE(Vector4i, VECTOR4I)
SGM_GODOT_TYPE(Quaternion, QUATERNION)
SGM_GODOT_TYPE(Color, COLOR)
SGM_GODOT_TYPE(Aabb, AABB)
SGM_GODOT_TYPE(Transform, TRANSFORM3D)
SGM_GODOT_TYPE(Rid, RID)
#undef SGM_GODOT_TYPE
template <class T>
concept PlainValue = requires {
  VariantType<T>::value;
};

class Variant {
 public:
  Variant() { std::memset(bytes_, 0, sizeof bytes_); }
  Variant(const Variant& other) { engine().variant_new_copy(bytes_, other.bytes_); }
  Variant(Variant&& other) noexcept {
    std::memcpy(bytes_, other.bytes_, sizeof bytes_);
    std::memset(other.bytes_, 0, sizeof bytes_);
  }
  Variant& operator=(Variant other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Variant() {
    if (type() != GDEXTENSION_VARIANT_TYPE_NIL) engine().variant_destroy(bytes_);
  }

  template <PlainValue T>
  Variant(T value) {
    engine().from_type[VariantType<T>::value](bytes_, &value);
  }
  template <class T>
  requires std::integral<T> &&(!PlainValue<T>)Variant(T value) : Variant(static_cast<int64_t>(value)) {}
  template <std::convertible_to<std::string_view> T>
  Variant(const T& text) {
    writeText(text);
  }
  Variant(const Name& name);
  Variant(Object object);  // the object as a value; nil if it is null
  /// An empty value of a type: a dictionary, an array, a packed array.
  static Variant ofType(GDExtensionVariantType type);
  static Variant dictionary() { return ofType(GDEXTENSION_VARIANT_TYPE_DICTIONARY); }
  static Variant array() { return ofType(GDEXTENSION_VARIANT_TYPE_ARRAY); }

  GDExtensionVariantType type() const {
    uint32_t number;
    std::memcpy(&number, bytes_, sizeof number);
    return static_cast<GDExtensionVariantType>(number);
  }
  bool isNil() const { return type() == GDEXTENSION_VARIANT_TYPE_NIL; }
  bool truth() const { return engine().variant_booleanize(bytes_) != 0; }

  /// Returns the value converted to another type, as the engine converts it; the empty value of that type if no
  /// conversion exists.
  template <class T>
  T to() const;
  Object object() const;  // null if the value is not an object

  /// Calls a method of an object or a built-in type. If the call fails, the error is written to the engine's log and
  /// the result is nil.
  template <class... Arguments>
  Variant call(const Name& method, const Arguments&... arguments) const {
    const std::array<Variant, sizeof...(Arguments)> values{Variant(arguments)...};
    std::array<const void*, sizeof...(Arguments) + 1> pointers{};
    for (size_t i = 0; i < values.size(); ++i) pointers[i] = values[i].raw();
    return callWith(method, pointers.data(), static_cast<int64_t>(values.size()));
  }
  template <class... Arguments>
  Variant call(std::string_view method, const Arguments&... arguments) const {
    return call(Name(method), arguments...);
  }

  Variant get(const Variant& key) const;  // the element of a dictionary or an array; nil if there is none
  bool has(const Variant& key) const;
  void set(const Variant& key, const Variant& value);
  void append(const Variant& value) const;  // appends an element to an array
  int64_t size() const;

  const void* raw() const { return bytes_; }
  void* raw() { return bytes_; }

 private:
  void writeText(std::string_view text);
  Variant callWith(const Name& method, const void* const* arguments, int64_t count) const;
  alignas(8) unsigned char bytes_[24];
};

template <>
bool Variant::to<bool>() const;  // Returns whether the value counts as true; accepts any type.
template <>
std::string Variant::to<std::string>() const;
template <class T>
T Variant::to() const {
  T value{};
  if (engine().variant_can_convert_strict(type(), static_cast<GDExtensionVariantType>(VariantType<T>::value))) {
    engine().to_type[VariantType<T>::value](&value, const_cast<unsigned char*>(bytes_));
  }
  return value;
}

/// Returns a method of an object as a value that can be connected to a signal.
Variant callable(Object object, const Name& method);
/// Returns a copy of the value at `value` as a Variant. `type`: the engine's type of that value; NIL: the value is a
/// Variant itself.
Variant fromTyped(GDExtensionVariantType type, const void* value);
/// Replaces the value at `place` by the value of `variant`. `type`: the engine's type of both values; NIL: the value at
/// `place` is a Variant itself.
void writeTyped(const Variant& variant, GDExtensionVariantType type, void* place);

/// A packed array of the engine that the plugin fills before it passes the array on as a Variant. T: uint8_t, int32_t,
/// int64_t, float, double, Vector2, Vector3, Color.
template <class T>
class Packed {
 public:
  explicit Packed(size_t size);
  ~Packed();
  Packed(const Packed&) = delete;
  Packed& operator=(const Packed&) = delete;
  T* data() { return data_; }  // the array's elements, for writing; null if size is 0
  size_t size() const { return size_; }
  Variant take() const;  // the finished array; it must not be written to afterwards

 private:
  alignas(8) unsigned char bytes_[16];
  T* data_ = nullptr;
  size_t size_;
};

/// The elements of a packed array that the engine has passed; empty if the Variant is not a packed array of T.
template <class T>
std::vector<T> elements(const Variant& packed);

/// A PackedStringArray with these texts.
Variant strings(const std::vector<std::string>& texts);

}  // namespace sgm_godot
