#pragma once
// Values of the engine. All values except plain numbers and vectors are Variants, and methods are called by name. This
// is slower than typed calls, but the plugin makes no call so often that it matters, and names stay the same from
// version to version.

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interface.h"

namespace sgm_godot {

// These types have the same layout as the engine's types in builds with single precision; the library refuses to run in
// other builds.
struct Vector2 {
  float x = 0, y = 0;
};
struct Vector3 {
  float x = 0, y = 0, z = 0;
  friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(Vector3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
};
struct Vector3i {
  int32_t x = 0, y = 0, z = 0;
  friend bool operator==(const Vector3i&, const Vector3i&) = default;
};
struct Vector4i {
  int32_t x = 0, y = 0, z = 0, w = 0;
};
struct Quaternion {
  float x = 0, y = 0, z = 0, w = 1;
};
struct Color {
  float r = 1, g = 1, b = 1, a = 1;
  friend bool operator==(const Color&, const Color&) = default;
};
struct Aabb {
  Vector3 position, size;
};
struct Transform {
  Vector3 rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vector3 origin;
  Vector3 column(int i) const {
    return i == 0   ? Vector3{rows[0].x, rows[1].x, rows[2].x}
           : i == 1 ? Vector3{rows[0].y, rows[1].y, rows[2].y}
                    : Vector3{rows[0].z, rows[1].z, rows[2].z};
  }
  /// The transform that applies `first`, then this transform.
  Transform after(const Transform& first) const;
  Vector3 apply(Vector3 v) const;
  Vector3 turn(Vector3 v) const;  // applies rotation and scale without the translation
  Transform inverse() const;      // of any invertible transform; otherwise the identity
};
struct Rid {
  uint64_t id = 0;
  explicit operator bool() const { return id != 0; }
};
static_assert(sizeof(Vector3) == 12 && sizeof(Transform) == 48 && sizeof(Aabb) == 24 && sizeof(Rid) == 8);

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

template <class T>
struct VariantType;  // `value`: the number of the engine's type that has the layout of T

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

  Variant(bool value);
  Variant(int64_t value);
  Variant(int32_t value) : Variant(int64_t{value}) {}
  Variant(uint32_t value) : Variant(int64_t{value}) {}
  Variant(uint64_t value) : Variant(static_cast<int64_t>(value)) {}
  Variant(double value);
  Variant(std::string_view text);
  Variant(const std::string& text) : Variant(std::string_view(text)) {}
  Variant(const char* text) : Variant(std::string_view(text)) {}
  Variant(const Name& name);
  Variant(Object object);
  template <class T, int = VariantType<T>::value>
  Variant(T value) {
    engine().from_type[VariantType<T>::value](bytes_, &value);
  }
  /// An empty value of a type, such as a dictionary, an array or a packed array.
  static Variant ofType(GDExtensionVariantType type);
  static Variant dictionary() { return ofType(GDEXTENSION_VARIANT_TYPE_DICTIONARY); }
  static Variant array() { return ofType(GDEXTENSION_VARIANT_TYPE_ARRAY); }
  static Variant callable(Object object, const Name& method);
  /// Makes a Variant from the engine value of the given type to which `value` points.
  static Variant fromTyped(GDExtensionVariantType type, const void* value);

  GDExtensionVariantType type() const {
    uint32_t number;
    std::memcpy(&number, bytes_, sizeof number);
    return static_cast<GDExtensionVariantType>(number);
  }
  bool isNil() const { return type() == GDEXTENSION_VARIANT_TYPE_NIL; }
  bool truth() const { return engine().variant_booleanize(bytes_) != 0; }

  /// The value as another type, converted as the engine does. If no conversion exists, the empty value of that type.
  template <class T>
  T to() const;
  Object object() const;
  /// Overwrites the engine value of the given type to which `value` points.
  void toTyped(GDExtensionVariantType type, void* value) const;

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
  void append(const Variant& value) const;  // appends to an array
  int64_t size() const;

  const void* raw() const { return bytes_; }
  void* raw() { return bytes_; }

 private:
  Variant callWith(const Name& method, const void* const* arguments, int64_t count) const;
  alignas(8) unsigned char bytes_[24];
};

#define SGM_GODOT_TYPE(T, TYPE)                                   \
  template <>                                                     \
  struct VariantType<T> {                                         \
    static constexpr int value = GDEXTENSION_VARIANT_TYPE_##TYPE; \
  };
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

template <>
bool Variant::to<bool>() const;
template <>
int64_t Variant::to<int64_t>() const;
template <>
double Variant::to<double>() const;
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

/// A packed array that must be filled completely before other code sees it. T: uint8_t, int32_t, int64_t, float,
/// double, Vector2, Vector3, Color.
template <class T>
class Packed {
 public:
  explicit Packed(size_t size);
  ~Packed();
  Packed(const Packed&) = delete;
  Packed& operator=(const Packed&) = delete;
  T* data() { return data_; }  // null if size is 0
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
