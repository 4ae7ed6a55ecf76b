#pragma once
// Converts C++ types to arguments and results of the methods that the engine calls, and back.

#include "instance.h"

namespace sgm_godot {

/// A dictionary, an array, or a packed array of numbers or strings. All of these have the C++ type Variant, so `type`
/// tells the engine's type.
template <GDExtensionVariantType type>
struct Typed {
  Variant value = Variant::ofType(type);
};
using Dictionary = Typed<GDEXTENSION_VARIANT_TYPE_DICTIONARY>;
using Array = Typed<GDEXTENSION_VARIANT_TYPE_ARRAY>;
using Strings = Typed<GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY>;
using Bytes = Typed<GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY>;
using Integers = Typed<GDEXTENSION_VARIANT_TYPE_PACKED_INT64_ARRAY>;
using Points = Typed<GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY>;

template <class T>
struct Conversion {
  static constexpr int type = VariantType<T>::value;
  static T from(const Variant& value) { return value.to<T>(); }
  static Variant into(const T& value) { return Variant(value); }
};
template <>
struct Conversion<std::string> {
  static constexpr int type = GDEXTENSION_VARIANT_TYPE_STRING;
  static std::string from(const Variant& value) { return value.to<std::string>(); }
  static Variant into(const std::string& value) { return Variant(value); }
};
template <GDExtensionVariantType number>
struct Conversion<Typed<number>> {
  static constexpr int type = number;
  static Typed<number> from(const Variant& value) { return {value.type() == number ? value : Variant::ofType(number)}; }
  static Variant into(const Typed<number>& value) { return value.value; }
};
template <>
struct Conversion<std::vector<std::string>> {
  static constexpr int type = GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY;
  static std::vector<std::string> from(const Variant& value) {
    std::vector<std::string> texts;
    // Accept an untyped array as well as a packed array: in a script, the literal ["one", "two"] is an untyped array.
    if (value.type() != GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY && value.type() != GDEXTENSION_VARIANT_TYPE_ARRAY)
      return texts;
    for (int64_t i = 0; i < value.size(); ++i) texts.push_back(value.call("get", i).to<std::string>());
    return texts;
  }
  static Variant into(const std::vector<std::string>& texts) { return strings(texts); }
};
/// A text that the engine passes as a StringName.
struct NameText {
  std::string text;
};
template <>
struct Conversion<NameText> {
  static constexpr int type = GDEXTENSION_VARIANT_TYPE_STRING_NAME;
  static NameText from(const Variant& value) { return {value.to<std::string>()}; }
  static Variant into(const NameText& value) { return Variant(Name(value.text)); }
};
template <>
struct Conversion<Variant> {
  static constexpr int type = GDEXTENSION_VARIANT_TYPE_NIL;  // the engine's type number for a Variant of any type
  static Variant from(const Variant& value) { return value; }
  static Variant into(const Variant& value) { return value; }
};
template <>
struct Conversion<Object> {
  static constexpr int type = GDEXTENSION_VARIANT_TYPE_OBJECT;
  static Object from(const Variant& value) { return value.object(); }
  static Variant into(Object value) { return Variant(value); }
};

template <class T>
using Bare = std::remove_cv_t<std::remove_reference_t<T>>;

}  // namespace sgm_godot
