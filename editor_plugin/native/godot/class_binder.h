#pragma once
// Registers classes of this plugin with the engine.

#include <deque>
#include <memory>

#include "method.h"

namespace sgm_godot {

/// Data of a registered class; the engine passes a pointer to it with every call that concerns the class. Must live as
/// long as the class is registered.
struct ClassRecord {
  Plugin* plugin;
  std::string name, parent;
  Instance* (*create)(Plugin&, Object);
  std::vector<std::pair<std::string, GDExtensionClassCallVirtual>> overrides;
  std::deque<std::vector<Variant>> defaults;  // for each method, the default values of its last arguments
};

struct Argument {
  std::string name;
  int type;
  std::string class_name = {};
};

/// How the inspector shows a property: a value of the engine's enum PropertyHint, and its hint string.
struct Hint {
  uint32_t kind = 0;
  std::string text = {};
  std::string class_name = {};
  uint32_t usage = 6;
};
inline Hint range(std::string text) { return {1, std::move(text)}; }
inline Hint choice(std::string text) { return {2, std::move(text)}; }

class ClassBinder {
 public:
  /// Begins to register the class T. The record must outlive the registration. exposed: scripts may use the class by
  /// its name.
  template <class T>
  static ClassBinder add(ClassRecord& record, bool exposed = true) {
    record.create = [](Plugin& plugin, Object self) -> Instance* { return new (std::nothrow) T(plugin, self); };
    return ClassBinder(record, exposed);
  }

  template <auto method>
  ClassBinder& method_(const char* name, const std::vector<const char*>& arguments = {},
                       const std::vector<Variant>& defaults = {}) {
    using Parts = decltype(partsOf(method));
    addMethod(name, Parts::shape(), arguments, defaults, &Parts::template call<method>,
              &Parts::template pointerCall<method>);
    return *this;
  }

  /// Adds an implementation of a virtual method of the parent class, such as "_load". Must be called before the class
  /// is registered, because the engine then reads ClassRecord::overrides.
  template <auto method>
  static void override_(ClassRecord& record, const char* name) {
    record.overrides.emplace_back(name, &decltype(partsOf(method))::template inPlace<method>);
  }

  template <auto setter, auto getter>
  ClassBinder& property(const std::string& name, const Hint& hint = {}) {
    method_<setter>(("set_" + name).c_str(), {"value"});
    method_<getter>(("get_" + name).c_str());
    addProperty(name, decltype(partsOf(getter))::shape().result, hint, "set_" + name);
    return *this;
  }
  template <auto getter>
  ClassBinder& readOnly(const std::string& name, const Hint& hint = {}) {
    method_<getter>(("get_" + name).c_str());
    addProperty(name, decltype(partsOf(getter))::shape().result, hint, "");
    return *this;
  }

  ClassBinder& group(const char* title, const char* prefix = "");
  ClassBinder& signal(const char* name, const std::vector<Argument>& arguments = {});

 private:
  ClassBinder(ClassRecord& record, bool exposed);
  void addMethod(const char* name, const MethodShape& shape, const std::vector<const char*>& arguments,
                 const std::vector<Variant>& defaults, GDExtensionClassMethodCall call,
                 GDExtensionClassMethodPtrCall pointer_call);
  void addProperty(const std::string& name, int type, const Hint& hint, const std::string& setter);

  ClassRecord& record_;
};

/// Unregisters a class. No object of the class may exist.
void removeClass(const ClassRecord& record);

}  // namespace sgm_godot
