#include "class_binder.h"

namespace sgm_godot {
namespace {

/// Owns a String object of the engine: creates it from UTF-8 text, and destroys it in the destructor.
class Text {
 public:
  explicit Text(std::string_view text) {
    engine().string_new_with_utf8_chars_and_len(bytes_, text.data(), static_cast<int64_t>(text.size()));
  }
  ~Text() { engine().destructor[GDEXTENSION_VARIANT_TYPE_STRING](bytes_); }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  void* get() { return bytes_; }

 private:
  alignas(8) unsigned char bytes_[8];
};

/// Describes a property, argument or result to the engine, and owns the strings to which the description points.
struct Description {
  Name name, class_name;
  Text hint_text;
  GDExtensionPropertyInfo info;
  Description(std::string_view named, int type, std::string_view of_class, uint32_t hint, std::string_view text,
              uint32_t usage)
      : name(named), class_name(of_class), hint_text(text) {
    info = {static_cast<GDExtensionVariantType>(type), name.get(), class_name.get(), hint, hint_text.get(), usage};
  }
};
constexpr uint32_t kUsageDefault = 6, kUsageNilIsVariant = 1 << 17;

uint32_t usageOf(int type) {
  return type == GDEXTENSION_VARIANT_TYPE_NIL ? kUsageDefault | kUsageNilIsVariant : kUsageDefault;
}

Instance& of(void* instance) { return *static_cast<Instance*>(instance); }
std::string textOf(const void* name) { return fromTyped(GDEXTENSION_VARIANT_TYPE_STRING_NAME, name).to<std::string>(); }

/// Runs a callback that the engine calls. Exceptions are caught and logged here, because the engine cannot handle C++
/// exceptions; the result is then 0.
template <class Function>
auto guarded(const Function& function) noexcept -> decltype(function()) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    logOutOfMemory("out of memory");
  } catch (const std::exception& e) {
    logOutOfMemory(e.what());
  }
  return decltype(function())();
}

GDExtensionBool setProperty(void* instance, const void* name, const void* value) {
  return guarded([&]() -> GDExtensionBool {
    Variant copy;
    engine().variant_new_copy(copy.raw(), value);
    return of(instance).set(textOf(name), copy);
  });
}

GDExtensionBool getProperty(void* instance, const void* name, void* result) {
  return guarded([&]() -> GDExtensionBool {
    Variant value;
    if (!of(instance).get(textOf(name), value)) return 0;
    *static_cast<Variant*>(result) = value;
    return 1;
  });
}

using Descriptions = std::vector<std::unique_ptr<Description>>;

// Lists the properties. When the engine frees the list, it passes back only the pointer to the list's first property.
// So the array has one more element before that property, which points to the strings; thus the strings can be freed
// too.
const GDExtensionPropertyInfo* describe(const Instance& instance, uint32_t* count) {
  const std::vector<Instance::Property> properties = instance.properties();
  auto described = std::make_unique<Descriptions>();
  auto list = std::make_unique<GDExtensionPropertyInfo[]>(properties.size() + 1);
  for (size_t i = 0; i < properties.size(); ++i) {
    const Instance::Property& p = properties[i];
    described->push_back(std::make_unique<Description>(p.name, p.type, p.class_name, p.hint, p.hint_text, p.usage));
    list[i + 1] = described->back()->info;
  }
  *count = static_cast<uint32_t>(properties.size());
  list[0].name = described.release();
  return list.release() + 1;
}

const GDExtensionPropertyInfo* listProperties(void* instance, uint32_t* count) {
  *count = 0;
  return guarded([&] { return describe(of(instance), count); });
}

void freeProperties(void*, const GDExtensionPropertyInfo* list, uint32_t) {
  if (list == nullptr) return;
  const GDExtensionPropertyInfo* first = list - 1;
  delete static_cast<Descriptions*>(first->name);
  delete[] first;
}

GDExtensionBool canRevert(void* instance, const void* name) {
  return guarded([&]() -> GDExtensionBool { return !of(instance).revertsTo(textOf(name)).isNil(); });
}

GDExtensionBool revert(void* instance, const void* name, void* result) {
  return guarded([&]() -> GDExtensionBool {
    const Variant value = of(instance).revertsTo(textOf(name));
    if (value.isNil()) return 0;
    *static_cast<Variant*>(result) = value;
    return 1;
  });
}

void notify(void* instance, int32_t what, GDExtensionBool) {
  guarded([&] { of(instance).notify(what); });
}

Object createInstance(void* userdata) {
  const ClassRecord& record = *static_cast<ClassRecord*>(userdata);
  const Name name(record.name), parent(record.parent);
  const Object object = engine().classdb_construct_object(parent.get());
  Instance* instance = record.create(*record.plugin, object);
  if (instance == nullptr) {
    logError("out of memory: there is no room for a " + record.name);
    return nullptr;
  }
  static constexpr GDExtensionInstanceBindingCallbacks kNoCallbacks{nullptr, nullptr, nullptr};
  engine().object_set_instance(object, name.get(), instance);
  engine().object_set_instance_binding(object, engine().library, instance, &kNoCallbacks);
  return object;
}

void freeInstance(void*, void* instance) { delete static_cast<Instance*>(instance); }

GDExtensionClassCallVirtual findVirtual(void* userdata, const void* name) {
  const std::string wanted = textOf(name);
  for (const auto& [overridden, function] : static_cast<ClassRecord*>(userdata)->overrides) {
    if (overridden == wanted) return function;
  }
  return nullptr;
}

}  // namespace

ClassBinder::ClassBinder(ClassRecord& record, bool exposed) : record_(record) {
  GDExtensionClassCreationInfo3 info{};
  info.is_exposed = exposed;
  info.set_func = setProperty;
  info.get_func = getProperty;
  info.get_property_list_func = listProperties;
  info.free_property_list_func = freeProperties;
  info.property_can_revert_func = canRevert;
  info.property_get_revert_func = revert;
  info.notification_func = notify;
  info.create_instance_func = createInstance;
  info.free_instance_func = freeInstance;
  info.get_virtual_func = findVirtual;
  info.class_userdata = &record;
  const Name name(record.name), parent(record.parent);
  engine().classdb_register_extension_class3(engine().library, name.get(), parent.get(), &info);
}

void ClassBinder::addMethod(const char* name, const MethodShape& shape, const std::vector<const char*>& arguments,
                            const std::vector<Variant>& defaults, GDExtensionClassMethodCall call,
                            GDExtensionClassMethodPtrCall pointer_call) {
  std::vector<std::unique_ptr<Description>> described;
  std::vector<GDExtensionPropertyInfo> infos;
  std::vector<GDExtensionClassMethodArgumentMetadata> metadata;
  const auto metadataOf = [](int type) {
    return type == GDEXTENSION_VARIANT_TYPE_INT     ? GDEXTENSION_METHOD_ARGUMENT_METADATA_INT_IS_INT64
           : type == GDEXTENSION_VARIANT_TYPE_FLOAT ? GDEXTENSION_METHOD_ARGUMENT_METADATA_REAL_IS_DOUBLE
                                                    : GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;
  };
  for (size_t i = 0; i < shape.arguments.size(); ++i) {
    const int type = shape.arguments[i];
    const char* argument = i < arguments.size() ? arguments[i] : "value";
    described.push_back(std::make_unique<Description>(argument, type, "", 0, "", usageOf(type)));
    infos.push_back(described.back()->info);
    metadata.push_back(metadataOf(type));
  }
  std::vector<Variant>& values = record_.defaults.emplace_back(defaults);
  std::vector<void*> pointers;
  for (Variant& value : values) pointers.push_back(value.raw());
  Description result("", std::max(shape.result, 0), "", 0, "", usageOf(shape.result));
  const Name owner(record_.name);
  Name method(name);
  GDExtensionClassMethodInfo info{};
  info.name = method.get();
  info.method_userdata = &values;
  info.call_func = call;
  info.ptrcall_func = pointer_call;
  info.method_flags = GDEXTENSION_METHOD_FLAGS_DEFAULT;
  info.has_return_value = shape.result >= 0;
  info.return_value_info = &result.info;
  info.return_value_metadata = metadataOf(shape.result);
  info.argument_count = static_cast<uint32_t>(infos.size());
  info.arguments_info = infos.data();
  info.arguments_metadata = metadata.data();
  info.default_argument_count = static_cast<uint32_t>(pointers.size());
  info.default_arguments = pointers.data();
  engine().classdb_register_extension_class_method(engine().library, owner.get(), &info);
}

void ClassBinder::addProperty(const std::string& name, int type, const Hint& hint, const std::string& setter) {
  const Description described(name, type, hint.class_name, hint.kind, hint.text, hint.usage);
  const Name owner(record_.name), set(setter), get("get_" + name);
  engine().classdb_register_extension_class_property(engine().library, owner.get(), &described.info, set.get(),
                                                     get.get());
}

ClassBinder& ClassBinder::group(const char* title, const char* prefix) {
  const Name owner(record_.name);
  Text name(title), start(prefix);
  engine().classdb_register_extension_class_property_group(engine().library, owner.get(), name.get(), start.get());
  return *this;
}

ClassBinder& ClassBinder::signal(const char* name, const std::vector<Argument>& arguments) {
  std::vector<std::unique_ptr<Description>> described;
  std::vector<GDExtensionPropertyInfo> infos;
  for (const Argument& a : arguments) {
    described.push_back(std::make_unique<Description>(a.name, a.type, a.class_name, 0, "", kUsageDefault));
    infos.push_back(described.back()->info);
  }
  const Name owner(record_.name), signal_name(name);
  engine().classdb_register_extension_class_signal(engine().library, owner.get(), signal_name.get(), infos.data(),
                                                   static_cast<int64_t>(infos.size()));
  return *this;
}

void removeClass(const ClassRecord& record) {
  const Name name(record.name);
  engine().classdb_unregister_extension_class(engine().library, name.get());
}

}  // namespace sgm_godot
