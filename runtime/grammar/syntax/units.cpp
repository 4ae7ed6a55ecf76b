#include "grammar/syntax/units.h"

#include "grammar/text/sink.h"

namespace sgm {

namespace {

std::string powerOf(std::string_view name, int power) {
  if (power == 0) return {};
  return power == 1 ? std::string(name) : join({name, "^", std::to_string(power)});
}

}  // namespace

std::string dimName(Dim dim) {
  if (dim == kRatio) return "ratio";
  if (dim == kArea) return "area";
  if (dim == kVolume) return "volume";
  const std::string length = powerOf("length", dim.length), angle = powerOf("angle", dim.angle);
  return join({length, length.empty() || angle.empty() ? "" : " ", angle});
}

std::string typeName(const Type& type) {
  const std::string_view stage = type.sample ? "sample-time " : "";
  switch (type.kind) {
    case ValueKind::unknown:
      return join({stage, "value"});
    case ValueKind::number:
      return join({stage, dimName(type.dim)});
    case ValueKind::boolean:
      return join({stage, "condition"});
    case ValueKind::vector:
      return type.dim == kLength ? join({stage, "point"}) : join({stage, "vector of ", dimName(type.dim), "s"});
    case ValueKind::pair:
      return join({stage, "pair of ", dimName(type.dim), "s"});
    case ValueKind::cell:
      return "cell";
    case ValueKind::face:
      return "face";
    case ValueKind::faces:
      return "list of faces";
    case ValueKind::segment:
      return "segment";
    case ValueKind::segments:
      return "list of segments";
    case ValueKind::plan:
      return "plan";
    case ValueKind::range:
      return "range";
    case ValueKind::text:
      return "text";
  }
  return "value";
}

std::string withArticle(const std::string& noun) { return (noun.find_first_of("aeiou") == 0 ? "an " : "a ") + noun; }

}  // namespace sgm
