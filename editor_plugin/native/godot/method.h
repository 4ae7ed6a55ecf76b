#pragma once
// Adapts a C++ member function to the engine's two calling conventions: with Variants, and with pointers to engine
// types.

#include <functional>
#include <new>

#include "conversion.h"
#include "log.h"

namespace sgm_godot {

struct MethodShape {
  std::vector<int> arguments;  // Variant types of the method's arguments
  int result = -1;             // Variant type of the result; -1: none
};

/// Describes and calls a member function of class C with the argument types A... and the result type R. If the function
/// is const, C is const too.
template <class C, class R, class... A>
struct MethodParts {
  static constexpr bool returns = !std::is_void_v<R>;

  static MethodShape shape() {
    MethodShape shape{{Conversion<Bare<A>>::type...}, -1};
    if constexpr (returns) shape.result = Conversion<Bare<R>>::type;
    return shape;
  }

  template <auto method, size_t... I>
  static Variant invoke(void* instance, const Variant* arguments, std::index_sequence<I...>) {
    auto& object = *static_cast<C*>(static_cast<Instance*>(instance));
    try {
      if constexpr (returns) {
        return Conversion<Bare<R>>::into(std::invoke(method, object, Conversion<Bare<A>>::from(arguments[I])...));
      } else {
        std::invoke(method, object, Conversion<Bare<A>>::from(arguments[I])...);
      }
    } catch (const std::bad_alloc&) {
      logOutOfMemory("out of memory");
    }
    return {};
  }

  /// Calls the method for a script. `userdata`: a vector of Variants with the default values of the last arguments.
  template <auto method>
  static void call(void* userdata, void* instance, const void* const* given, int64_t count, void* result,
                   GDExtensionCallError* error) {
    std::array<Variant, sizeof...(A) + 1> arguments;
    constexpr std::array<int, sizeof...(A) + 1> types{Conversion<Bare<A>>::type..., 0};
    const auto& defaults = *static_cast<const std::vector<Variant>*>(userdata);
    const auto passed = static_cast<size_t>(count);
    if (passed > sizeof...(A) || passed + defaults.size() < sizeof...(A)) {
      error->error =
          passed > sizeof...(A) ? GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS : GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS;
      error->expected = static_cast<int32_t>(sizeof...(A) - (passed > sizeof...(A) ? 0 : defaults.size()));
      return;
    }
    for (size_t i = 0; i < sizeof...(A); ++i) {
      if (i < passed) {
        engine().variant_new_copy(arguments[i].raw(), given[i]);
      } else {
        arguments[i] = defaults[defaults.size() - (sizeof...(A) - i)];
      }
      const auto type = static_cast<GDExtensionVariantType>(types[i]);
      if (type != GDEXTENSION_VARIANT_TYPE_NIL && !engine().variant_can_convert_strict(arguments[i].type(), type)) {
        *error = {GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT, static_cast<int32_t>(i), types[i]};
        return;
      }
    }
    error->error = GDEXTENSION_CALL_OK;
    *static_cast<Variant*>(result) = invoke<method>(instance, arguments.data(), std::index_sequence_for<A...>());
  }

  template <auto method>
  static void inPlace(void* instance, const void* const* given, void* result) {
    std::array<Variant, sizeof...(A) + 1> arguments;
    constexpr std::array<int, sizeof...(A) + 1> types{Conversion<Bare<A>>::type..., 0};
    for (size_t i = 0; i < sizeof...(A); ++i) {
      arguments[i] = fromTyped(static_cast<GDExtensionVariantType>(types[i]), given[i]);
    }
    const Variant made = invoke<method>(instance, arguments.data(), std::index_sequence_for<A...>());
    if constexpr (returns) writeTyped(made, static_cast<GDExtensionVariantType>(Conversion<Bare<R>>::type), result);
  }

  template <auto method>
  static void pointerCall(void*, void* instance, const void* const* given, void* result) {
    inPlace<method>(instance, given, result);
  }
};

template <class C, class R, class... A>
MethodParts<C, R, A...> partsOf(R (C::*)(A...));
template <class C, class R, class... A>
MethodParts<C, R, A...> partsOf(R (C::*)(A...) const);
template <class C, class R, class... A>
MethodParts<C, R, A...> partsOf(R (*)(C&, A...));

}  // namespace sgm_godot
