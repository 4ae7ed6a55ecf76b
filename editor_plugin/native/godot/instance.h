#pragma once
// What every object of this plugin's is to the engine.

#include "variant.h"

namespace sgm_godot {

struct Plugin;

/// The C++ half of an object whose class this plugin registers. The engine makes and ends it with its own half.
class Instance {
 public:
  Instance(Plugin& plugin, Object self) : plugin_(plugin), self_(self) {}
  virtual ~Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// The engine's notifications: its numbers are in the classes' documentation.
  virtual void notify(int32_t) {}

  /// A property that the class did not register, such as one of a grammar's parameters.
  virtual bool set(const std::string& /*name*/, const Variant& /*value*/) { return false; }
  virtual bool get(const std::string& /*name*/, Variant& /*value*/) const { return false; }

  /// Such a property, for the inspector. What it goes back to, or nil where nothing is known of it.
  struct Property {
    std::string name;
    GDExtensionVariantType type = GDEXTENSION_VARIANT_TYPE_NIL;
    std::string class_name;
    uint32_t hint = 0;
    std::string hint_text;
    uint32_t usage = 6;  // stored and shown
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

/// This plugin's half of an object; null where it is another's.
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
