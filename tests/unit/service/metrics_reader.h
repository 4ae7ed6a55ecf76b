#pragma once
// A strict reader of Prometheus' text format, which rejects every deviation.

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.h"

namespace sgm::service {

struct Series {
  std::string name;  ///< name of the series, including the suffix _bucket, _sum or _count
  std::vector<std::pair<std::string, std::string>> labels;
  double value = 0;

  std::string label(std::string_view of) const {
    for (const auto& [name_of, value_of] : labels)
      if (name_of == of) return value_of;
    return {};
  }
};
struct Family {
  std::string help, type;
  std::vector<Series> series;
};
using Metrics = std::map<std::string, Family>;

/// Parses metrics. Fails the test at the first error.
class MetricsReader {
 public:
  static Metrics read(std::string_view text) {
    MetricsReader reader{text};
    reader.readAll();
    return std::move(reader.metrics_);
  }

 private:
  explicit MetricsReader(std::string_view text) : text_(text) {}

  static bool isWord(std::string_view word) {
    if (word.empty() || (word[0] >= '0' && word[0] <= '9')) return false;
    for (const char c : word)
      if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_')) return false;
    return true;
  }

  void readAll() {
    REQUIRE(text_.size() > 0);
    REQUIRE(text_.back() == '\n');
    while (!text_.empty()) {
      const size_t end = text_.find('\n');
      readLine(text_.substr(0, end));
      text_.remove_prefix(end + 1);
    }
    for (const auto& [name, family] : metrics_) {
      CAPTURE(name);
      REQUIRE(!family.series.empty());
      if (family.type == "histogram") checkHistogram(name, family);
    }
  }

  /// Splits the text after "# HELP " or "# TYPE " into the name of the metric and the rest.
  static std::pair<std::string, std::string> take(std::string_view line) {
    const size_t space = line.find(' ');
    REQUIRE(space != line.npos);
    return {std::string(line.substr(0, space)), std::string(line.substr(space + 1))};
  }

  void readLine(std::string_view line) {
    INFO(std::string(line));
    if (line.substr(0, 7) == "# HELP ") {
      const auto [name, help] = take(line.substr(7));
      REQUIRE(isWord(name));
      REQUIRE(help.size() > 3);
      REQUIRE(metrics_.count(name) == 0);  // each metric family must occur only once, with all of its series together
      metrics_[name].help = help;
      now_ = name;
    } else if (line.substr(0, 7) == "# TYPE ") {
      const auto [name, type] = take(line.substr(7));
      REQUIRE(name == now_);
      REQUIRE(metrics_[name].type.empty());
      REQUIRE(metrics_[name].series.empty());
      REQUIRE((type == "counter" || type == "gauge" || type == "histogram"));
      REQUIRE((type == "counter") == (name.size() > 6 && name.substr(name.size() - 6) == "_total"));
      metrics_[name].type = type;
    } else {
      readSeries(line);
    }
  }

  void readSeries(std::string_view line) {
    Series series;
    size_t at = line.find_first_of("{ ");
    REQUIRE(at != line.npos);
    series.name = std::string(line.substr(0, at));
    Family& family = metrics_[now_];
    REQUIRE(!family.type.empty());
    const std::string suffix = series.name.substr(std::min(series.name.size(), now_.size()));
    REQUIRE(series.name == now_ + suffix);
    REQUIRE(
        (family.type == "histogram" ? suffix == "_bucket" || suffix == "_sum" || suffix == "_count" : suffix.empty()));
    if (line[at] == '{') at = readLabels(line, at + 1, series);
    REQUIRE(line[at] == ' ');
    series.value = number(line.substr(at + 1));
    if (family.type == "counter") REQUIRE(series.value >= 0);
    std::set<std::pair<std::string, std::string>> sorted(series.labels.begin(), series.labels.end());
    std::string identity = series.name;
    for (const auto& [name, value] : sorted) identity += '\0' + name + '\0' + value;
    REQUIRE(seen_.insert(identity).second);
    family.series.push_back(std::move(series));
  }

  static size_t readLabels(std::string_view line, size_t at, Series& series) {
    std::set<std::string> names;
    for (;;) {
      const size_t equals = line.find('=', at);
      REQUIRE(equals != line.npos);
      const std::string name(line.substr(at, equals - at));
      REQUIRE(isWord(name));
      REQUIRE(names.insert(name).second);
      REQUIRE(line[equals + 1] == '"');
      std::string value;
      for (at = equals + 2;; ++at) {
        REQUIRE(at < line.size());
        if (line[at] == '"') break;
        if (line[at] != '\\') {
          value += line[at];
          continue;
        }
        ++at;
        REQUIRE(at < line.size());
        REQUIRE((line[at] == 'n' || line[at] == '"' || line[at] == '\\'));
        value += line[at] == 'n' ? '\n' : line[at];
      }
      series.labels.emplace_back(name, value);
      ++at;
      REQUIRE(at < line.size());
      if (line[at] == '}') return at + 1;
      REQUIRE(line[at] == ',');
      ++at;
    }
  }

  static double number(std::string_view text) {
    if (text == "+Inf") return std::numeric_limits<double>::infinity();
    if (text == "-Inf") return -std::numeric_limits<double>::infinity();
    if (text == "Nan" || text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    REQUIRE(!text.empty());
    REQUIRE(text.find_first_not_of("0123456789+-.e") == text.npos);
    size_t taken = 0;
    const double value = std::stod(std::string(text), &taken);
    REQUIRE(taken == text.size());
    return value;
  }

  static void checkHistogram(const std::string& name, const Family& family) {
    struct One {
      std::vector<std::pair<double, double>> buckets;
      int sums = 0, counts = 0;
      double count = 0;
    };
    std::map<std::string, One> all;
    for (const Series& series : family.series) {
      std::string identity;
      for (const auto& [label, value] : series.labels)
        if (label != "le") identity += label + '\0' + value + '\0';
      One& one = all[identity];
      if (series.name == name + "_bucket") {
        one.buckets.emplace_back(number(series.label("le")), series.value);
      } else {
        REQUIRE(series.label("le").empty());
        if (series.name == name + "_sum") ++one.sums;
        if (series.name == name + "_count") ++one.counts, one.count = series.value;
      }
    }
    for (const auto& [identity, one] : all) {
      REQUIRE(one.sums == 1);
      REQUIRE(one.counts == 1);
      REQUIRE(one.buckets.size() > 1);
      for (size_t i = 1; i < one.buckets.size(); ++i) {
        REQUIRE(one.buckets[i].first > one.buckets[i - 1].first);
        REQUIRE(one.buckets[i].second >= one.buckets[i - 1].second);
      }
      REQUIRE(std::isinf(one.buckets.back().first));
      REQUIRE(one.buckets.back().second == one.count);
    }
  }

  std::string_view text_;
  std::string now_;
  Metrics metrics_;
  std::set<std::string> seen_;
};

}  // namespace sgm::service
