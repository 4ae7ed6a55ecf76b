#pragma once
// Makes fields of the grammar cave.sgm with other parameters, and fields of edited versions of its text.

#include <memory>
#include <string>
#include <vector>

#include "streaming_support.h"

namespace sgm {

inline std::shared_ptr<const WorldField> fieldOf(WorldFieldSettings settings) {
  return std::make_shared<const WorldField>(std::move(settings), std::pmr::get_default_resource());
}

inline std::shared_ptr<const WorldField> fieldOf(const std::string& text, const std::string& parameter = "",
                                                 double value = 0) {
  WorldFieldSettings settings = settingsOf(text, kStreamedCell, 3);
  if (!parameter.empty()) REQUIRE(settings.parameters.set(*settings.program, parameter, value));
  return fieldOf(std::move(settings));
}

/// The cave with all its layers. Its stalactites (the layer `drip`) appear at levels with cells of up to half a metre.
inline std::string drippingText() { return replaced(yardstick("cave.sgm"), "detail 0.3m", "detail 0.6m"); }

/// The grammar drippingText() after an edit that an author might make; `what` describes the edit.
struct EditedText {
  std::string what, text;
};

inline std::vector<EditedText> editedTexts() {
  const std::string cave = drippingText();
  return {
      {"layout alone", replaced(cave, "  anchor spawn", "  // here\n     anchor spawn")},
      {"a rule's number", replaced(cave, "sphere(0.7*r)", "sphere(0.72*r)")},
      {"an anchor's name", replaced(cave, "anchor spawn \"chamber\"", "anchor spawn \"hall\"")},
      {"a material's name", replaced(cave, "mat calcite", "mat aragonite")},
      {"a layer less", replaced(cave, "layer drip cell 24m reach 5m uses net { start Drips; }", "")},
      {"a layer's cells", replaced(cave, "drip cell 24m", "drip cell 20m")},
      {"a weight", replaced(cave, "Hall(r) weight 1", "Hall(r) weight 2")},
      {"a layer's detail", replaced(cave, "reach 176m detail 4m", "reach 176m detail 1m")},
      {"a layer more", replaced(cave, "rule Node {",
                                "layer more cell 64m reach 8m { start Pearl; }\n"
                                "rule Pearl { at(20m, 20m, 20m) sphere(6m); }\nrule Node {")},
      {"the domain", replaced(cave, "solid limestone", "solid granite")},
      {"what drips", replaced(cave, "scatter poisson(2.2m)", "scatter poisson(2.3m)")},
  };
}

}  // namespace sgm
