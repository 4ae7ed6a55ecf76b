#pragma once
// The engine's loader and saver for .sgm files as resources.

#include "godot/conversion.h"

namespace sgm_godot {

struct ClassRecord;

class GrammarLoader : public Instance {
 public:
  using Instance::Instance;
  static void registerClass(ClassRecord& record);

 private:
  Strings extensions() const;
  bool handles(const NameText& type) const;
  std::string typeOf(const std::string& path) const;
  bool exists(const std::string& path) const;
  Strings dependencies(const std::string& path, bool with_types) const;
  Variant load(const std::string& path, const std::string& original, bool threads, int64_t cache) const;
};

class GrammarSaver : public Instance {
 public:
  using Instance::Instance;
  static void registerClass(ClassRecord& record);

 private:
  bool recognises(Object resource) const;
  Strings extensions(Object resource) const;
  int64_t save(Object resource, const std::string& path, int64_t flags) const;
};

}  // namespace sgm_godot
