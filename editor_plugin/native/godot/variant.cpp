#include "variant.h"

#include "log.h"

namespace sgm_godot {
namespace {

using Type = GDExtensionVariantType;

}  // namespace

Name::Name(std::string_view text) {
  engine().string_name_new_with_utf8_chars_and_len(bytes_, text.data(), static_cast<int64_t>(text.size()));
}
Name::~Name() { engine().destructor[GDEXTENSION_VARIANT_TYPE_STRING_NAME](bytes_); }

void Variant::writeText(std::string_view text) {
  alignas(8) unsigned char string[8];
  engine().string_new_with_utf8_chars_and_len(string, text.data(), static_cast<int64_t>(text.size()));
  engine().from_type[GDEXTENSION_VARIANT_TYPE_STRING](bytes_, string);
  engine().destructor[GDEXTENSION_VARIANT_TYPE_STRING](string);
}
Variant::Variant(const Name& name) {
  engine().from_type[GDEXTENSION_VARIANT_TYPE_STRING_NAME](bytes_, const_cast<void*>(name.get()));
}
Variant::Variant(Object object) {
  if (object == nullptr) {
    std::memset(bytes_, 0, sizeof bytes_);
  } else {
    engine().from_type[GDEXTENSION_VARIANT_TYPE_OBJECT](bytes_, &object);
  }
}

Variant Variant::ofType(Type type) {
  Variant result;
  GDExtensionCallError error{};
  engine().variant_construct(type, result.bytes_, nullptr, 0, &error);
  return result;
}

Variant callable(Object object, const Name& method) {
  const Variant owner(object), name(method);
  const void* arguments[] = {owner.raw(), name.raw()};
  Variant result;
  GDExtensionCallError error{};
  engine().variant_construct(GDEXTENSION_VARIANT_TYPE_CALLABLE, result.raw(), arguments, 2, &error);
  return result;
}

Variant fromTyped(Type type, const void* value) {
  Variant result;
  if (type == GDEXTENSION_VARIANT_TYPE_NIL) {
    engine().variant_new_copy(result.raw(), value);
  } else {
    engine().from_type[type](result.raw(), const_cast<void*>(value));
  }
  return result;
}

void writeTyped(const Variant& variant, Type type, void* place) {
  if (type == GDEXTENSION_VARIANT_TYPE_NIL) {
    engine().variant_destroy(place);
    engine().variant_new_copy(place, variant.raw());
    return;
  }
  // Even an empty value at `place` may own memory, so destroy it before it is overwritten.
  if (engine().destructor[type] != nullptr) engine().destructor[type](place);
  engine().to_type[type](place, const_cast<void*>(variant.raw()));
}

template <>
bool Variant::to<bool>() const {
  return truth();
}
template <>
std::string Variant::to<std::string>() const {
  if (!engine().variant_can_convert_strict(type(), GDEXTENSION_VARIANT_TYPE_STRING)) return {};
  alignas(8) unsigned char string[8];
  engine().to_type[GDEXTENSION_VARIANT_TYPE_STRING](string, const_cast<unsigned char*>(bytes_));
  std::string text(static_cast<size_t>(engine().string_to_utf8_chars(string, nullptr, 0)), '\0');
  engine().string_to_utf8_chars(string, text.data(), static_cast<int64_t>(text.size()));
  engine().destructor[GDEXTENSION_VARIANT_TYPE_STRING](string);
  return text;
}

Object Variant::object() const {
  Object object = nullptr;
  if (type() == GDEXTENSION_VARIANT_TYPE_OBJECT) {
    engine().to_type[GDEXTENSION_VARIANT_TYPE_OBJECT](&object, const_cast<unsigned char*>(bytes_));
  }
  return object;
}

Variant Variant::callWith(const Name& method, const void* const* arguments, int64_t count) const {
  Variant result;
  GDExtensionCallError error{};
  engine().variant_call(const_cast<unsigned char*>(bytes_), method.get(), arguments, count, result.bytes_, &error);
  if (error.error != GDEXTENSION_CALL_OK) {
    logError("the engine refused a call of " + Variant(method).to<std::string>() + " (error " +
             std::to_string(error.error) + ", argument " + std::to_string(error.argument) +
             "); this plugin and this engine do not fit together");
    return {};
  }
  return result;
}

Variant Variant::get(const Variant& key) const {
  Variant result;
  GDExtensionBool valid = 0;
  engine().variant_get(bytes_, key.raw(), result.bytes_, &valid);
  return valid ? std::move(result) : Variant();
}

bool Variant::has(const Variant& key) const {
  GDExtensionBool valid = 0;
  return engine().variant_has_key(bytes_, key.raw(), &valid) && valid;
}

void Variant::set(const Variant& key, const Variant& value) {
  GDExtensionBool valid = 0;
  engine().variant_set(bytes_, key.raw(), value.raw(), &valid);
}

void Variant::append(const Variant& value) const { call("append", value); }
int64_t Variant::size() const { return call("size").to<int64_t>(); }

namespace {

template <class T>
struct PackedType;
#define SGM_GODOT_PACKED(T, TYPE, function)                                                                   \
  template <>                                                                                                 \
  struct PackedType<T> {                                                                                      \
    static constexpr Type type = GDEXTENSION_VARIANT_TYPE_PACKED_##TYPE##_ARRAY;                              \
    static T* first(void* array) { return static_cast<T*>(static_cast<void*>(engine().function(array, 0))); } \
  };
SGM_GODOT_PACKED(uint8_t, BYTE, packed_byte_array_operator_index)
SGM_GODOT_PACKED(int32_t, INT32, packed_int32_array_operator_index)
SGM_GODOT_PACKED(int64_t, INT64, packed_int64_array_operator_index)
SGM_GODOT_PACKED(float, FLOAT32, packed_float32_array_operator_index)
SGM_GODOT_PACKED(double, FLOAT64, packed_float64_array_operator_index)
SGM_GODOT_PACKED(Vector2, VECTOR2, packed_vector2_array_operator_index)
SGM_GODOT_PACKED(Vector3, VECTOR3, packed_vector3_array_operator_index)
SGM_GODOT_PACKED(Color, COLOR, packed_color_array_operator_index)
#undef SGM_GODOT_PACKED

}  // namespace

template <class T>
Packed<T>::Packed(size_t size) : size_(size) {
  {
    const Variant array = Variant::ofType(PackedType<T>::type);
    array.call("resize", static_cast<int64_t>(size));
    if (array.size() != static_cast<int64_t>(size)) throw std::bad_alloc();
    engine().to_type[PackedType<T>::type](bytes_, const_cast<void*>(array.raw()));
  }
  // At this point the array has a single reference, so that obtaining a pointer for writing does not copy it.
  if (size != 0) data_ = PackedType<T>::first(bytes_);
}
template <class T>
Packed<T>::~Packed() {
  engine().destructor[PackedType<T>::type](bytes_);
}
template <class T>
Variant Packed<T>::take() const {
  return fromTyped(PackedType<T>::type, bytes_);
}

template <class T>
std::vector<T> elements(const Variant& packed) {
  if (packed.type() != PackedType<T>::type) return {};
  std::vector<T> result(static_cast<size_t>(packed.size()));
  if (result.empty()) return result;
  alignas(8) unsigned char bytes[16];
  engine().to_type[PackedType<T>::type](bytes, const_cast<void*>(packed.raw()));
  std::memcpy(static_cast<void*>(result.data()), PackedType<T>::first(bytes), result.size() * sizeof(T));
  engine().destructor[PackedType<T>::type](bytes);
  return result;
}

template class Packed<uint8_t>;
template class Packed<int32_t>;
template class Packed<int64_t>;
template class Packed<float>;
template class Packed<double>;
template class Packed<Vector2>;
template class Packed<Vector3>;
template class Packed<Color>;
template std::vector<uint8_t> elements(const Variant&);
template std::vector<int64_t> elements(const Variant&);

Variant strings(const std::vector<std::string>& texts) {
  Variant result = Variant::ofType(GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY);
  for (const std::string& text : texts) result.call("append", text);
  return result;
}

}  // namespace sgm_godot
