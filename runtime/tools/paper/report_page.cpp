#include "tools/paper/report_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "tools/paper/printed.h"
#include "tools/paper/report_style.h"

namespace sgm::cli {
namespace {

constexpr const char* kTitle = "The paper, reproduced";

Markup paragraph(std::string_view words) { return element("p", words) + Markup{"\n"}; }

Markup link(const std::string& id, std::string_view words) { return element("a", {{"href", "#" + id}}, text(words)); }

bool isAt(const Contradiction& found, std::string_view place) {
  return std::ranges::any_of(found.places, [place](const char* at) { return at == place; });
}

/// The readable form of a name in Contradiction::places: "figure-10" becomes "figure 10".
std::string placeName(std::string place) {
  std::ranges::replace(place, '-', ' ');
  return place;
}

std::string numberId(size_t number) { return fmt::format("contradiction-{}", number); }

Markup commandsOf(const std::vector<std::string>& commands) {
  std::string lines;
  for (const std::string& command : commands) lines += command + "\n";
  const Markup list = element("pre", element("code", lines)) + Markup{"\n"};
  constexpr size_t kShown = 4;
  if (commands.size() <= kShown) return list;
  return element("details", element("summary", fmt::format("{} commands that repeat it", commands.size())) + list) +
         Markup{"\n"};
}

Markup sectionOf(const ReportItem& report_item) {
  Markup printed;
  for (const std::string& quote : report_item.printed) printed += paragraph(quote);
  Markup content = element("h2", report_item.title) + Markup{"\n"};
  content += element("h3", "The paper") + Markup{"\n"} + element("blockquote", printed) + Markup{"\n"};
  const std::vector<Contradiction> all = contradictions();
  for (size_t i = 0; i < all.size(); ++i) {
    if (!isAt(all[i], report_item.id)) continue;
    const Markup number = link(numberId(i + 1), fmt::format("Contradiction {}", i + 1));
    content +=
        element("div", {{"class", "contradiction"}}, element("p", number + text(". " + all[i].text))) + Markup{"\n"};
  }
  content += element("h3", "Ours") + Markup{"\n"} + report_item.ours;
  content += element("h3", "How it was measured") + Markup{"\n"} + paragraph(report_item.measured);
  content += commandsOf(report_item.commands);
  return element("section", {{"id", report_item.id}}, content) + Markup{"\n"};
}

Markup contradictionList(std::span<const ReportItem> report_items) {
  const std::vector<Contradiction> all = contradictions();
  Markup items;
  for (size_t i = 0; i < all.size(); ++i) {
    Markup places;
    for (const std::string place : all[i].places) {
      if (!places.html.empty()) places += text(", ");
      const bool shown = std::ranges::any_of(report_items, [&](const ReportItem& e) { return e.id == place; });
      places += shown ? link(place, placeName(place)) : text(placeName(place));
    }
    items += element("li", {{"id", numberId(i + 1)}}, text(all[i].text + " (") + places + text(")")) + Markup{"\n"};
  }
  return element("section", {{"id", "contradictions"}},
                 element("h2", "Where the paper contradicts itself") + Markup{"\n"} + element("ol", items)) +
         Markup{"\n"};
}

Markup contents(std::span<const ReportItem> report_items) {
  Markup items;
  for (const ReportItem& report_item : report_items)
    items += element("li", link(report_item.id, report_item.title)) + Markup{"\n"};
  items += element("li", link("contradictions", "Where the paper contradicts itself"));
  return element("nav", {{"aria-label", "Contents"}}, element("ul", items)) + Markup{"\n"};
}

}  // namespace

std::string reportPage(const ReportFacts& facts, std::span<const ReportItem> report_items) {
  Markup head = emptyElement("meta", {{"charset", "utf-8"}});
  head += emptyElement("meta", {{"name", "generator"}, {"content", "sgm paper"}});
  head += emptyElement("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  head += element("title", kTitle) + element("style", Markup{kReportStyle});

  Markup body = element("h1", kTitle) + Markup{"\n"};
  body +=
      element("p", text("Figures and tables of ") +
                       element("cite",
                               "Shape Metamorphosis – Automatic 3D Mesh Generation, Topology Verification "
                               "and Analysis") +
                       text(", beside those of this runtime. The run that wrote this page made every picture, chart "
                            "and number of ours. Those of the paper are quoted from its captions, text and tables."));
  if (facts.quick)
    body += element("p", element("strong", "A quick run: ") +
                             text("larger cells, fewer runs and models and smaller pictures than without --quick."));
  if (!facts.pictures) body += paragraph("There are no pictures, because --no-pictures was given.");
  if (!facts.whole) body += paragraph("The report has only the parts that --only names.");
  Markup machine;
  for (const auto& [name, what] : facts.machine) machine += element("dt", name) + element("dd", what);
  body += element("dl", machine) + Markup{"\n"};
  body += element("p", text("Run the commands in the folder of this page. Its folder ") + element("code", "grammars") +
                           text(" has their input; their output goes beside this folder. Everything is reproducible, "
                                "except times and values that depend on them."));
  body += contents(report_items);
  for (const ReportItem& report_item : report_items) body += sectionOf(report_item);
  body += contradictionList(report_items);
  return "<!DOCTYPE html>\n" +
         element("html", {{"lang", "en"}}, Markup{"\n"} + element("head", head) + Markup{"\n"} + element("body", body))
             .html +
         "\n";
}

}  // namespace sgm::cli
