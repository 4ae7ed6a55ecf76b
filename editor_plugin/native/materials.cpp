#include "materials.h"

#include <cmath>

#include "godot/log.h"
#include "palette.h"
#include "plugin.h"

namespace sgm_godot {
namespace {

constexpr const char* kShaders[] = {"res://addons/sgm/shaders/triplanar.gdshader",
                                    "res://addons/sgm/shaders/uv.gdshader"};
constexpr size_t kMaxColors = 64, kMaxViewers = 4;  // sizes of the arrays that the shaders declare
constexpr int kPatternMetres = 1024;                // metres after which the patterns of the shaders repeat

Variant singleton(const char* name) { return Variant(engine().global_get_singleton(Name(name).get())); }

Variant make(const char* class_name) { return Variant(engine().classdb_construct_object(Name(class_name).get())); }

/// Returns a variant of the plugin's shader with only those patterns that the world's materials use, since a shader
/// with all patterns takes seconds to compile. Worlds that use the same patterns share this variant. It is made again
/// if the shader's file has changed, or if no world was using it any more.
Variant shaderWith(Plugin& plugin, const Variant& whole, const std::string& path, uint32_t patterns) {
  std::string code = "#define SGM_PATTERNS_CHOSEN\n";
  for (uint32_t i = 0; i < 32; ++i) {
    if (patterns >> i & 1u) code += "#define SGM_PATTERN_" + std::to_string(i) + "\n";
  }
  code += whole.call("get_code").to<std::string>();
  uint64_t& id = plugin.shaders[{path, patterns}];
  if (const Object there = id == 0 ? nullptr : engine().object_get_instance_from_id(id); there != nullptr) {
    const Variant shared(there);
    if (shared.call("get_code").to<std::string>() == code) return shared;
  }
  const Variant shader = make("Shader");
  shader.call("set_code", code);
  id = engine().object_get_instance_id(shader.object());
  return shader;
}

Variant ownMaterial(Plugin& plugin, int64_t mapping, uint32_t patterns) {
  const char* path = kShaders[mapping == 1 ? 1 : 0];
  const Variant loader = singleton("ResourceLoader");
  if (loader.call("exists", path).truth()) {
    const Variant shader = loader.call("load", path);
    if (shader.object() != nullptr) {
      const Variant material = make("ShaderMaterial");
      material.call("set_shader", shaderWith(plugin, shader, path, patterns));
      return material;
    }
  }
  logWarning(std::string(path) + " is missing: surfaces are drawn plainly; copy the whole folder addons/sgm");
  return make("StandardMaterial3D");
}

}  // namespace

void Materials::rebuild(Plugin& plugin, const std::vector<std::string>& names, const Settings& settings) {
  slots_.assign(names.size(), 0);
  palette_.clear();
  looks_.clear();
  uint32_t patterns = 0;
  for (const std::string& name : names) {
    looks_.push_back(sgm::lookOf(name));
    patterns |= uint32_t{1} << static_cast<uint32_t>(looks_.back().pattern);
  }
  materials_.assign(1, {"", Variant(), ownMaterial(plugin, settings.mapping, patterns)});
  for (size_t i = 0; i < names.size(); ++i) {
    const auto color = settings.colors.find(names[i]);
    palette_.push_back(color != settings.colors.end() ? color->second : colorOf(names[i]));
    const auto chosen = settings.materials.find(names[i]);
    if (chosen == settings.materials.end() || chosen->second.object() == nullptr) continue;
    slots_[i] = static_cast<uint16_t>(materials_.size());
    materials_.push_back({names[i], chosen->second, chosen->second});
  }
  sent_ = false;
}

std::vector<Rid> Materials::rids() const {
  std::vector<Rid> result;
  for (const Slot& slot : materials_) result.push_back(slot.used.call("get_rid").to<Rid>());
  return result;
}

// Sets a parameter directly at the RenderingServer, not in the material: the material may be a file, which an editor
// would then save with the parameter.
void Materials::send(const char* parameter, const Variant& value) const {
  const Variant server = singleton("RenderingServer");
  const Name set("material_set_param"), name(parameter);
  for (const Slot& slot : materials_) server.call(set, slot.used.call("get_rid"), name, value);
}

void Materials::update(const std::vector<Vector3>& viewers, const MorphRanges& ranges, double cell_size,
                       const Placement& placement) {
  if (!sent_) {
    // The arrays always have their full length: the engine pads shorter ones, but with warnings in some versions.
    Packed<Color> colors(kMaxColors);
    Packed<int32_t> patterns(kMaxColors);
    Packed<float> reliefs(kMaxColors);
    for (size_t i = 0; i < kMaxColors; ++i) {
      const sgm::MaterialLook look = i < looks_.size() ? looks_[i] : sgm::MaterialLook();
      colors.data()[i] = i < palette_.size() ? linear(palette_[i]) : Color{};
      patterns.data()[i] = static_cast<int32_t>(look.pattern);
      reliefs.data()[i] = look.relief;
    }
    send("material_colors", colors.take());
    send("material_patterns", patterns.take());
    send("material_reliefs", reliefs.take());
    send("cell_size", cell_size);
    const auto wrapped = [](int32_t metres) { return static_cast<float>(metres % kPatternMetres); };
    send("pattern_offset",
         Vector3{wrapped(placement.origin.x), wrapped(placement.origin.y), wrapped(placement.origin.z)} -
             placement.node.origin);
  }
  const bool moved = viewers.size() != viewers_.size() ||
                     std::memcmp(viewers.data(), viewers_.data(), viewers.size() * sizeof(Vector3)) != 0;
  if (moved || !sent_) {
    Packed<Vector3> places(kMaxViewers);
    for (size_t i = 0; i < kMaxViewers; ++i) places.data()[i] = i < viewers.size() ? viewers[i] : Vector3{};
    send("viewers", places.take());
    send("viewer_count", static_cast<int64_t>(std::min(viewers.size(), kMaxViewers)));
    viewers_ = viewers;
  }
  if (!(ranges == ranges_) || !sent_) {
    Packed<float> begin(ranges.begin.size()), end(ranges.end.size());
    std::copy(ranges.begin.begin(), ranges.begin.end(), begin.data());
    std::copy(ranges.end.begin(), ranges.end.end(), end.data());
    send("morph_begin", begin.take());
    send("morph_end", end.take());
    ranges_ = ranges;
  }
  sent_ = true;
}

}  // namespace sgm_godot
