#include "world/edits.h"

#include <algorithm>
#include <cmath>

#include "godot/error.h"
#include "godot/log.h"
#include "number_text.h"

namespace sgm_godot {
namespace {

int32_t roundedUnits(double units) {
  return static_cast<int32_t>(std::clamp(std::round(units), double{INT32_MIN}, double{INT32_MAX}));
}
int32_t lengthUnits(double metres) { return roundedUnits(metres * SGM_UNITS_PER_METRE); }

void place(const Placement& placement, const Vector3& position, int32_t units[3]) {
  const Units exact = placement.toUnits(position);
  for (size_t axis = 0; axis < 3; ++axis) units[axis] = roundedUnits(exact[axis]);
}

/// Whether a length of a brush lies between `least` and 1,024 m; otherwise logs an error.
bool isLength(const char* what, double metres, double least) {
  constexpr double kMost = 1024;
  if (metres >= least && metres <= kMost) return true;
  logError(std::string("SgmWorld3D: a brush's ") + what + " is " + numberText(metres) + " m; it may be from " +
           (least > 0 ? "1/1,024" : "0") + " to 1,024 m");
  return false;
}
constexpr double kLeast = 1.0 / SGM_UNITS_PER_METRE;

/// A key of a brush dictionary, with the two types that its value may have.
struct Key {
  const char* name;
  GDExtensionVariantType type, other;
  const char* described;
};
constexpr Key kKeys[] = {
    {"shape", GDEXTENSION_VARIANT_TYPE_STRING, GDEXTENSION_VARIANT_TYPE_STRING_NAME, "a text"},
    {"cut", GDEXTENSION_VARIANT_TYPE_BOOL, GDEXTENSION_VARIANT_TYPE_BOOL, "true or false"},
    {"position", GDEXTENSION_VARIANT_TYPE_VECTOR3, GDEXTENSION_VARIANT_TYPE_VECTOR3I, "a Vector3"},
    {"to", GDEXTENSION_VARIANT_TYPE_VECTOR3, GDEXTENSION_VARIANT_TYPE_VECTOR3I, "a Vector3"},
    {"radius", GDEXTENSION_VARIANT_TYPE_FLOAT, GDEXTENSION_VARIANT_TYPE_INT, "a number"},
    {"size", GDEXTENSION_VARIANT_TYPE_VECTOR3, GDEXTENSION_VARIANT_TYPE_VECTOR3I, "a Vector3"},
    {"rotation", GDEXTENSION_VARIANT_TYPE_QUATERNION, GDEXTENSION_VARIANT_TYPE_QUATERNION, "a Quaternion"},
    {"smooth", GDEXTENSION_VARIANT_TYPE_FLOAT, GDEXTENSION_VARIANT_TYPE_INT, "a number"},
    {"material", GDEXTENSION_VARIANT_TYPE_STRING, GDEXTENSION_VARIANT_TYPE_STRING_NAME, "a text"},
    {"tag", GDEXTENSION_VARIANT_TYPE_STRING, GDEXTENSION_VARIANT_TYPE_STRING_NAME, "a text"},
};

/// Whether a brush has only known keys with values of the right types; otherwise logs an error.
bool hasOnlyKeys(const Variant& brush) {
  const Variant names = brush.call("keys");
  const int64_t count = names.size();
  for (int64_t i = 0; i < count; ++i) {
    const Variant name = names.get(i);
    const std::string text = name.to<std::string>();
    const auto* key = std::find_if(std::begin(kKeys), std::end(kKeys), [&](const Key& k) { return text == k.name; });
    if (key == std::end(kKeys)) {
      std::string known;
      for (const Key& k : kKeys) known += std::string(known.empty() ? "" : ", ") + k.name;
      logError("SgmWorld3D.edit: a brush has no '" + text + "'; it may have " + known);
      return false;
    }
    const GDExtensionVariantType type = brush.get(name).type();
    if (type != key->type && type != key->other) {
      logError(std::string("SgmWorld3D.edit: the brush's ") + key->name + " has to be " + key->described);
      return false;
    }
  }
  return true;
}

Integers idOf(const sgm_edit_id& id) {
  Packed<int64_t> numbers(2);
  numbers.data()[0] = static_cast<int64_t>(id.author);
  numbers.data()[1] = static_cast<int64_t>(id.number);
  return {numbers.take()};
}

std::optional<uint16_t> materialNumber(const World& world, const std::string& name) {
  if (name.empty()) return uint16_t{0};
  const std::vector<std::string> names = materialNames(world.node().compiled().get());
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<uint16_t>(i);
  }
  std::string known;
  for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
  logError("SgmWorld3D: the grammar has no material '" + name + "'; it has " + known);
  return std::nullopt;
}

std::optional<uint16_t> tagNumber(const World& world, const std::string& name) {
  if (name.empty()) return uint16_t{0};
  const sgm_grammar* grammar = world.stage().session()->grammar().get();
  for (uint32_t i = 0; i < sgm_grammar_tag_count(grammar); ++i) {
    if (name == sgm_grammar_tag(grammar, i)) return static_cast<uint16_t>(i);
  }
  logError("SgmWorld3D: the grammar has no tag '" + name + "'");
  return std::nullopt;
}

/// Emits the signal `edited`, and returns the edit's id for scripts. A handler of the signal may have destroyed the
/// world.
Integers announceEdit(World& world, const sgm_edit_id& id) {
  const Integers numbers = idOf(id);
  world.messages().announce("edited", numbers.value);
  world.messages().emit();
  return numbers;
}

Integers lay(World& world, const sgm_brush& brush) {
  sgm_edit_id id{};
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_edit(world.stage().session()->world(), &brush, &id, &error) < SGM_OK) {
    logError(std::string("SgmWorld3D: ") + error.message);
    return {};
  }
  return announceEdit(world, id);
}

/// Returns a sphere without a material as a brush; nullopt, after logging an error, if a length is out of its range.
std::optional<sgm_brush> sphere(const World& world, const Vector3& position, double radius, double smooth) {
  if (!isLength("radius", radius, kLeast) || !isLength("smooth", smooth, 0)) return std::nullopt;
  sgm_brush brush = SGM_BRUSH_INIT;
  place(world.node().placement(), position, brush.from);
  brush.radius = lengthUnits(radius);
  brush.smooth = lengthUnits(smooth);
  return brush;
}

}  // namespace

Integers dig(World& world, const Vector3& position, double radius, double smooth) {
  if (!world.isReady()) return {};
  const std::optional<sgm_brush> brush = sphere(world, position, radius, smooth);
  return brush ? lay(world, *brush) : Integers();
}

Integers build(World& world, const Vector3& position, double radius, const std::string& material, double smooth) {
  if (!world.isReady()) return {};
  std::optional<sgm_brush> brush = sphere(world, position, radius, smooth);
  if (!brush) return {};
  const std::optional<uint16_t> number = materialNumber(world, material);
  if (!number) return {};
  brush->cut = 0;
  brush->material = *number;
  return lay(world, *brush);
}

Integers edit(World& world, const Dictionary& given) {
  if (!world.isReady() || !hasOnlyKeys(given.value)) return {};
  const auto value = [&](const char* key, const Variant& otherwise) {
    const Variant v = given.value.get(key);
    return v.isNil() ? otherwise : v;
  };
  const std::string shape = value("shape", "sphere").to<std::string>();
  sgm_brush brush = SGM_BRUSH_INIT;
  if (shape == "sphere") {
    brush.shape = SGM_BRUSH_SPHERE;
  } else if (shape == "box") {
    brush.shape = SGM_BRUSH_BOX;
  } else if (shape == "capsule") {
    brush.shape = SGM_BRUSH_CAPSULE;
  } else {
    logError("SgmWorld3D.edit: the brush has the shape '" + shape + "'; use sphere, box or capsule");
    return {};
  }
  const std::optional<uint16_t> material = materialNumber(world, value("material", "").to<std::string>());
  const std::optional<uint16_t> tag = tagNumber(world, value("tag", "").to<std::string>());
  if (!material || !tag) return {};
  const Placement here = world.node().placement();
  brush.cut = value("cut", true).truth() ? 1 : 0;
  brush.material = *material;
  brush.tag = *tag;
  place(here, value("position", Vector3{}).to<Vector3>(), brush.from);
  place(here, value("to", Vector3{}).to<Vector3>(), brush.to);
  const Vector3 half = value("size", Vector3{1, 1, 1}).to<Vector3>();
  const double radius = value("radius", 1.0).to<double>(), smooth = value("smooth", 0.0).to<double>();
  const bool box = brush.shape == SGM_BRUSH_BOX;
  if (!isLength("smooth", smooth, 0) || (!box && !isLength("radius", radius, kLeast))) return {};
  if (box && !isLength("size.x", double{half.x}, kLeast)) return {};
  if (box && (!isLength("size.y", double{half.y}, kLeast) || !isLength("size.z", double{half.z}, kLeast))) return {};
  brush.half[0] = lengthUnits(double{half.x});
  brush.half[1] = lengthUnits(double{half.y});
  brush.half[2] = lengthUnits(double{half.z});
  const Quaternion turn = value("rotation", Quaternion{}).to<Quaternion>();
  brush.turn[0] = turn.x;
  brush.turn[1] = turn.y;
  brush.turn[2] = turn.z;
  brush.turn[3] = turn.w;
  brush.radius = lengthUnits(radius);
  brush.smooth = lengthUnits(smooth);
  return lay(world, brush);
}

Integers undo(World& world, const Integers& id) {
  const std::vector<int64_t> numbers = elements<int64_t>(id.value);
  if (!world.isReady()) return {};
  if (numbers.size() != 2) {
    logError("SgmWorld3D.undo: this is no edit's id; use what dig, build, edit or undo returned");
    return {};
  }
  const sgm_edit_id known{static_cast<uint64_t>(numbers[0]), static_cast<uint64_t>(numbers[1])};
  sgm_edit_id made{};
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_undo(world.stage().session()->world(), &known, &made, &error) < SGM_OK) {
    logError(std::string("SgmWorld3D: ") + error.message);
    return {};
  }
  return announceEdit(world, made);
}

int64_t countEdits(const World& world) {
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  if (!world.stage().isRunning() || sgm_world_get_stats(world.stage().session()->world(), &stats, nullptr) != SGM_OK)
    return 0;
  return static_cast<int64_t>(stats.edits);
}

Bytes exportEdits(World& world, int64_t since) {
  if (!world.isReady() || since < 0) return {};
  std::vector<uint8_t> bytes;
  size_t count = 0;
  sgm_error error = SGM_ERROR_INIT;
  sgm_result result;
  // Another thread may add edits between the call that returns the size and the call that copies the bytes.
  do {
    bytes.resize(count);
    result = sgm_world_export_edits(world.stage().session()->world(), static_cast<uint64_t>(since), bytes.data(),
                                    &count, &error);
  } while (result == SGM_INCOMPLETE || (result == SGM_OK && count > bytes.size()));
  if (result < SGM_OK) {
    logError(std::string("SgmWorld3D: ") + error.message);
    return {};
  }
  Packed<uint8_t> packed(count);
  if (count != 0) std::memcpy(packed.data(), bytes.data(), count);
  return {packed.take()};
}

int64_t importEdits(World& world, const Bytes& given) {
  if (!world.isReady()) return kErrorUnconfigured;
  const std::vector<uint8_t> bytes = elements<uint8_t>(given.value);
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_import_edits(world.stage().session()->world(), bytes.data(), bytes.size(), &error) >= SGM_OK)
    return kOk;
  logError(std::string("SgmWorld3D: ") + error.message);
  return error.code == SGM_ERR_DATA ? kErrorInvalidData : kFailed;
}

int64_t flushEdits(World& world) {
  if (!world.isReady()) return kErrorUnconfigured;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_flush_edits(world.stage().session()->world(), &error) >= SGM_OK) return kOk;
  logError(std::string("SgmWorld3D: ") + error.message);
  return kFailed;
}

int64_t hashEdits(const World& world) {
  return world.stage().isRunning() ? static_cast<int64_t>(sgm_world_edits_hash(world.stage().session()->world())) : 0;
}

}  // namespace sgm_godot
