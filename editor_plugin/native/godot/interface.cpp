#include "interface.h"

namespace sgm_godot {
namespace {

Interface& loaded() {
  static Interface table;
  return table;
}

}  // namespace

const Interface& engine() { return loaded(); }

const char* loadInterface(GDExtensionInterfaceGetProcAddress address, GDExtensionClassLibraryPtr library) {
  Interface& table = loaded();
  table.library = library;
#define SGM_GODOT_LOAD(type, name)                                                                    \
  table.name = reinterpret_cast<GDExtensionInterface##type>(reinterpret_cast<void*>(address(#name))); \
  if (table.name == nullptr) return #name;
  SGM_GODOT_FUNCTIONS(SGM_GODOT_LOAD)
#undef SGM_GODOT_LOAD
  table.load_help = reinterpret_cast<decltype(table.load_help)>(
      reinterpret_cast<void*>(address("editor_help_load_xml_from_utf8_chars_and_len")));
  for (int i = GDEXTENSION_VARIANT_TYPE_BOOL; i < GDEXTENSION_VARIANT_TYPE_VARIANT_MAX; ++i) {
    const auto type = static_cast<GDExtensionVariantType>(i);
    table.from_type[i] = table.get_variant_from_type_constructor(type);
    table.to_type[i] = table.get_variant_to_type_constructor(type);
    table.destructor[i] = table.variant_get_ptr_destructor(type);
  }
  return nullptr;
}

}  // namespace sgm_godot
