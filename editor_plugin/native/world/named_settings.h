#pragma once
// The properties parameters/NAME, materials/NAME and colors/NAME, whose names come from the grammar. `grammar` may be
// null.

#include <optional>

#include "grammar.h"
#include "settings.h"

namespace sgm_godot {

/// Changes one of these properties. Returns the effect of the change; nullopt if the name belongs to another property.
std::optional<Settings::Effect> setNamed(Settings& settings, const std::string& name, const Variant& value);
/// The property's value; nullopt if the name belongs to another property, or to a parameter that neither the settings
/// nor the grammar have.
std::optional<Variant> namedValue(const Settings& settings, const sgm_grammar* grammar, const std::string& name);
/// The value that the inspector reverts the property to; nil if there is none.
Variant namedDefault(const sgm_grammar* grammar, const std::string& name);
/// All of these properties, for the inspector.
std::vector<Instance::Property> namedProperties(const Settings& settings, const sgm_grammar* grammar);

}  // namespace sgm_godot
