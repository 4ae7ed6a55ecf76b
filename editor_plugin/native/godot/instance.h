#pragma once
// The base class of all objects of this plugin that the engine knows.

#include "variant.h"

namespace sgm_godot {

struct Plugin;

/// The C++ part of an engine object whose class this plugin registers. The engine creates and destroys this part
/// together with the object's own part in the engine.
class Instance {
 public:
  Instance(Plugin& plugin, Object self) : plugin_(plugin), self_(self) {}
  virtual ~Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Receives the engine's notifications; the documentation of the engine's classes lists their numbers.
  virtual void notify(int32_t) {}

  /// Sets a property that was not registered with the class, such as a parameter of a grammar. Returns false if it is
  /// unknown.
  virtual bool set(const std::string& /*name*/, const Variant& /*value*/) { return false; }
  virtual bool get(const std::string& /*name*/, Variant& /*value*/) const { return false; }

  /// Describes, to the inspector, a property that was not registered with the class.
  struct Property {
    std::string name;
    GDExtensionVariantType type = GDEXTENSION_VARIANT_TYPE_NIL;
    std::string class_name;
    uint32_t hint = 0;
    std::string hint_text;
    uint32_t usage = 6;  // flags of the engine's enum PropertyUsageFlags; 6: the property is stored in files and shown
                         // in the editor
  };
  virtual std::vector<Property> properties() const { return {}; }
  virtual Variant revertsTo(const std::string& /*name*/) const { return {}; }

  Object self() const { return self_; }

 protected:
  template <class... Arguments>
  Variant own(std::string_view method, const Arguments&... arguments) const {
    return Variant(self_).call(method, arguments...);
  }
  template <class... Arguments>
  void emit(std::string_view signal, const Arguments&... arguments) const {
    Variant(self_).call("emit_signal", Variant(Name(signal)), arguments...);
  }
  Plugin& plugin() const { return plugin_; }

 private:
  Plugin& plugin_;
  Object self_;
};

/// The C++ part of an object; null if this plugin has not registered its class.
template <class T>
T* instanceOf(Object object) {
  if (object == nullptr) return nullptr;
  return dynamic_cast<T*>(
      static_cast<Instance*>(engine().object_get_instance_binding(object, engine().library, nullptr)));
}
template <class T>
T* instanceOf(const Variant& object) {
  return instanceOf<T>(object.object());
}

}  // namespace sgm_godot
