#pragma once
// The engine's C interface (gdextension_interface.h). The functions are looked up by name once, when the engine loads
// the library.

#include <gdextension_interface.h>

namespace sgm_godot {

// The list of the engine's functions. X(type, name): a function with the type GDExtensionInterface<type> and the name
// "name". All exist since Godot 4.3.
#define SGM_GODOT_FUNCTIONS(X)                                                                   \
  X(ArrayOperatorIndex, array_operator_index)                                                    \
  X(ClassdbConstructObject, classdb_construct_object)                                            \
  X(ClassdbGetMethodBind, classdb_get_method_bind)                                               \
  X(ClassdbRegisterExtensionClass3, classdb_register_extension_class3)                           \
  X(ClassdbRegisterExtensionClassMethod, classdb_register_extension_class_method)                \
  X(ClassdbRegisterExtensionClassProperty, classdb_register_extension_class_property)            \
  X(ClassdbRegisterExtensionClassPropertyGroup, classdb_register_extension_class_property_group) \
  X(ClassdbRegisterExtensionClassSignal, classdb_register_extension_class_signal)                \
  X(ClassdbUnregisterExtensionClass, classdb_unregister_extension_class)                         \
  X(GetGodotVersion, get_godot_version)                                                          \
  X(GetVariantFromTypeConstructor, get_variant_from_type_constructor)                            \
  X(GetVariantToTypeConstructor, get_variant_to_type_constructor)                                \
  X(GlobalGetSingleton, global_get_singleton)                                                    \
  X(ObjectGetInstanceBinding, object_get_instance_binding)                                       \
  X(ObjectGetInstanceFromId, object_get_instance_from_id)                                        \
  X(ObjectGetInstanceId, object_get_instance_id)                                                 \
  X(ObjectMethodBindCall, object_method_bind_call)                                               \
  X(ObjectSetInstance, object_set_instance)                                                      \
  X(ObjectSetInstanceBinding, object_set_instance_binding)                                       \
  X(PackedByteArrayOperatorIndex, packed_byte_array_operator_index)                              \
  X(PackedFloat64ArrayOperatorIndex, packed_float64_array_operator_index)                        \
  X(PackedInt32ArrayOperatorIndex, packed_int32_array_operator_index)                            \
  X(PackedInt64ArrayOperatorIndex, packed_int64_array_operator_index)                            \
  X(PackedVector2ArrayOperatorIndex, packed_vector2_array_operator_index)                        \
  X(PackedVector3ArrayOperatorIndex, packed_vector3_array_operator_index)                        \
  X(PackedColorArrayOperatorIndex, packed_color_array_operator_index)                            \
  X(PackedFloat32ArrayOperatorIndex, packed_float32_array_operator_index)                        \
  X(PrintErrorWithMessage, print_error_with_message)                                             \
  X(PrintWarningWithMessage, print_warning_with_message)                                         \
  X(StringNameNewWithUtf8CharsAndLen, string_name_new_with_utf8_chars_and_len)                   \
  X(StringNewWithUtf8CharsAndLen, string_new_with_utf8_chars_and_len)                            \
  X(StringToUtf8Chars, string_to_utf8_chars)                                                     \
  X(VariantBooleanize, variant_booleanize)                                                       \
  X(VariantCall, variant_call)                                                                   \
  X(VariantCanConvertStrict, variant_can_convert_strict)                                         \
  X(VariantConstruct, variant_construct)                                                         \
  X(VariantDestroy, variant_destroy)                                                             \
  X(VariantGet, variant_get)                                                                     \
  X(VariantGetPtrDestructor, variant_get_ptr_destructor)                                         \
  X(VariantGetType, variant_get_type)                                                            \
  X(VariantHasKey, variant_has_key)                                                              \
  X(VariantHash, variant_hash)                                                                   \
  X(VariantNewCopy, variant_new_copy)                                                            \
  X(VariantSet, variant_set)

struct Interface {
#define SGM_GODOT_DECLARE(type, name) GDExtensionInterface##type name = nullptr;
  SGM_GODOT_FUNCTIONS(SGM_GODOT_DECLARE)
#undef SGM_GODOT_DECLARE
  /// The function editor_help_load_xml_from_utf8_chars_and_len; null if the engine is not an editor.
  void (*load_help)(const char* xml, GDExtensionInt size) = nullptr;
  GDExtensionClassLibraryPtr library = nullptr;
  GDExtensionVariantFromTypeConstructorFunc from_type[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX] = {};
  GDExtensionTypeFromVariantConstructorFunc to_type[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX] = {};
  GDExtensionPtrDestructor destructor[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX] = {};
};

/// The engine's functions. They are global, because destructors of engine values call them wherever such values are
/// held. They are written once, before any other code of this library runs, and never changed.
const Interface& engine();

/// Looks up all functions. Returns null, or the name of the first function that this engine does not have.
const char* loadInterface(GDExtensionInterfaceGetProcAddress address, GDExtensionClassLibraryPtr library);

}  // namespace sgm_godot
