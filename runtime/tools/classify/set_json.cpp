#include "tools/classify/set_json.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/json_reader.h"
#include "base/utf8.h"

namespace sgm::masters {
namespace {

using measure::HistogramMode;
using measure::Master;
using measure::MasterKey;
using measure::MasterLimits;

constexpr size_t kLongestClass = 64, kLongestName = 256;
constexpr double kMaxLength = 1e9;

/// Reads a MasterSet from JSON. Stops at the first problem.
class SetReader {
 public:
  ReadSet run(const JsonValue& json) {
    MasterSet set;
    members(json, "", {"masters", "limits"}, {"from", "writable"});
    for (const JsonValue& of : array(json, "limits", 1, kMaxSetKeys)) limits(of, set);
    for (const JsonValue& of : array(json, "masters", 1, kMaxSetMasters)) master(of, set);
    if (!wrong_) everyKeyHasMasters(set);
    ReadSet read;
    if (wrong_) {
      read.what = what_;
      read.pointer = pointer_;
    } else {
      read.set = std::move(set);
    }
    return read;
  }

 private:
  void fail(const std::string& what, const std::string& pointer) {
    if (wrong_) return;
    wrong_ = true;
    what_ = what;
    pointer_ = pointer;
  }

  /// Requires an object with the `wanted` members, each exactly once. Members named in `passed_over` are optional and
  /// ignored.
  void members(const JsonValue& json, const std::string& at, std::initializer_list<std::string_view> wanted,
               std::initializer_list<std::string_view> passed_over = {}) {
    if (json.kind != JsonValue::Kind::object) return fail("an object is expected here", at);
    const auto has = [](std::initializer_list<std::string_view> names, const std::string& name) {
      return std::ranges::find(names, name) != names.end();
    };
    for (size_t i = 0; i < json.names.size(); ++i) {
      const std::string& name = json.names[i];
      const bool known = has(wanted, name) || has(passed_over, name);
      // The message does not repeat the name of an unknown member, because the client chose that text.
      if (!known) return fail("unknown member", at);
      if (std::find(json.names.begin(), json.names.begin() + static_cast<std::ptrdiff_t>(i), name) !=
          json.names.begin() + static_cast<std::ptrdiff_t>(i))
        return fail("duplicate member", at + "/" + name);
    }
    for (const std::string_view name : wanted)
      if (json.find(name) == nullptr) return fail("the member `" + std::string(name) + "` is missing", at);
  }

  std::span<const JsonValue> array(const JsonValue& json, const std::string& name, size_t least, size_t most) {
    if (wrong_) return {};
    if (json.find(name)->kind != JsonValue::Kind::array) {
      fail("an array is expected here", "/" + name);
      return {};
    }
    const std::span<const JsonValue> items = json.list(name);
    if (items.size() < least || items.size() > most) {
      fail("from " + std::to_string(least) + " to " + std::to_string(most) + " elements are expected here, not " +
               std::to_string(items.size()),
           "/" + name);
      return {};
    }
    return items;
  }

  double number(const JsonValue& json, const std::string& name, const std::string& at, double least, double most) {
    if (wrong_) return 0;
    const JsonValue& value = *json.find(name);
    const bool fits = value.kind == JsonValue::Kind::number && value.number >= least && value.number <= most;
    if (!fits) fail("a number from " + textOf(least) + " to " + textOf(most) + " is expected here", at + "/" + name);
    return value.number;
  }

  uint32_t whole(const JsonValue& json, const std::string& name, const std::string& at, uint32_t least, uint32_t most) {
    const double value = number(json, name, at, least, most);
    if (wrong_) return least;
    if (value != std::floor(value)) fail("a whole number is expected here", at + "/" + name);
    return static_cast<uint32_t>(value);
  }

  std::string text(const JsonValue& json, const std::string& name, const std::string& at, size_t longest) {
    if (wrong_) return {};
    const JsonValue& value = *json.find(name);
    // The JSON reader accepts only UTF-8, so only control characters must be rejected here.
    const bool controls =
        std::ranges::any_of(value.text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    if (value.kind != JsonValue::Kind::text || value.text.empty() || value.text.size() > longest || controls)
      fail("a string of 1 to " + std::to_string(longest) + " bytes without control characters is expected here",
           at + "/" + name);
    return value.text;
  }

  MasterKey key(const JsonValue& json, const std::string& in) {
    MasterKey key;
    if (wrong_) return key;
    const std::string at = in + "/key";
    const JsonValue& of = *json.find("key");
    members(of, at, {"mode", "bins", "length", "density", "version"});
    const std::optional<HistogramMode> mode = measure::modeNamed(text(of, "mode", at, kLongestName));
    if (!mode) fail("unknown mode: use `printed`, `corrected` or `curvature`", at + "/mode");
    key.mode = mode.value_or(key.mode);
    key.bins = whole(of, "bins", at, 1, 4096);
    const bool curvature = key.mode == HistogramMode::curvature;
    key.length = number(of, "length", at, curvature ? 1 / kMaxLength : 0, curvature ? kMaxLength : 0);
    key.density = number(of, "density", at, 0, curvature ? 0 : kMaxLength);
    key.version = whole(of, "version", at, measure::kMasterVersion, measure::kMasterVersion);
    return key;
  }

  void limits(const JsonValue& json, MasterSet& set) {
    const std::string at = "/limits/" + std::to_string(set.limits.size());
    members(json, at, {"key", "mse", "emd"});
    MasterLimits limits;
    limits.key = key(json, at);
    limits.mse = number(json, "mse", at, 0, kMaxLength);
    limits.emd = number(json, "emd", at, 0, kMaxLength);
    if (set.limitsOf(limits.key) != nullptr) fail("this key already has limits", at + "/key");
    set.limits.push_back(limits);
  }

  void master(const JsonValue& json, MasterSet& set) {
    const std::string at = "/masters/" + std::to_string(set.masters.size());
    members(json, at, {"class", "name", "models", "key", "shares"});
    if (wrong_) return;
    Master master;
    master.class_name = text(json, "class", at, kLongestClass);
    if (master.class_name == measure::kUnknown)
      fail("`unknown` is not a class of reference histograms: name another class", at + "/class");
    master.name = text(json, "name", at, kLongestName);
    master.models = whole(json, "models", at, 0, std::numeric_limits<uint32_t>::max());
    master.key = key(json, at);
    const auto of = std::ranges::find(set.limits, master.key, &MasterLimits::key);
    if (of == set.limits.end()) fail("this key has no limits: add it to `limits`", at + "/key");
    if (wrong_) return;
    const auto number_of_key = of - set.limits.begin();
    with_masters_.insert(number_of_key);
    if (!names_.emplace(number_of_key, master.class_name, master.name).second)
      fail("this name, class and key are already those of another reference histogram", at + "/name");
    master.shares = shares(json, at + "/shares", measure::binsOf(master.key.settings()));
    set.masters.push_back(std::move(master));
  }

  std::vector<double> shares(const JsonValue& json, const std::string& at, size_t bins) {
    const std::span<const JsonValue> items = json.list("shares");
    if (items.size() != bins)
      fail("an array of " + std::to_string(bins) + " shares is expected here, as the key says", at);
    std::vector<double> shares;
    for (size_t i = 0; !wrong_ && i < items.size(); ++i) {
      const bool fits = items[i].kind == JsonValue::Kind::number && items[i].number >= 0 && items[i].number <= 1;
      if (!fits) fail("a number from 0 to 1 is expected here", at + "/" + std::to_string(i));
      shares.push_back(items[i].number);
    }
    // The reader of the database uses the same tolerance, so it accepts every histogram that is accepted here.
    if (!(std::fabs(std::accumulate(shares.begin(), shares.end(), 0.0) - 1) < 1e-9))
      fail("these shares do not add up to 1", at);
    return shares;
  }

  void everyKeyHasMasters(const MasterSet& set) {
    for (size_t i = 0; i < set.limits.size(); ++i)
      if (!with_masters_.contains(static_cast<std::ptrdiff_t>(i)))
        return fail("there is no reference histogram for this key", "/limits/" + std::to_string(i) + "/key");
  }

  static std::string textOf(double number) {
    const std::string text = std::to_string(number);
    return text.substr(0, std::max(text.find_last_not_of(".0"), text.find('.') - 1) + 1);
  }

  bool wrong_ = false;
  std::string what_, pointer_;
  std::set<std::tuple<std::ptrdiff_t, std::string, std::string>> names_;
  /// Indices in MasterSet::limits of the keys for which a reference histogram was read.
  std::set<std::ptrdiff_t> with_masters_;
};

}  // namespace

ReadSet readSet(std::string_view json) {
  ReadSet read;
  if (json.size() > kMaxSetBytes) {
    read.what = "reference histograms may have at most " + std::to_string(kMaxSetBytes >> 20) + " MB of JSON";
    return read;
  }
  const Result<JsonValue> value = readJson(json);
  if (!value) {
    read.malformed = true;
    read.what = value.error().message;
    return read;
  }
  return SetReader().run(*value);
}

}  // namespace sgm::masters
