#pragma once
// Handles the properties parameters/NAME, materials/NAME and colors/NAME, whose names come from the grammar. `grammar`
// may be null.

#include <optional>

#include "grammar.h"
#include "settings.h"

namespace sgm_godot {

/// Sets the property parameters/NAME, materials/NAME or colors/NAME. Returns the effect of the change; nullopt for
/// any other name.
std::optional<Settings::Effect> setNamed(Settings& settings, const std::string& name, const Variant& value);
/// Returns the value of the property parameters/NAME, materials/NAME or colors/NAME; nullopt for any other name, or if
/// neither the settings nor the grammar have a parameter NAME.
std::optional<Variant> namedValue(const Settings& settings, const sgm_grammar* grammar, const std::string& name);
/// Returns the value to which the inspector reverts the property; nil if there is none.
Variant namedDefault(const sgm_grammar* grammar, const std::string& name);
/// Describes all properties parameters/NAME, materials/NAME and colors/NAME to the inspector.
std::vector<Instance::Property> namedProperties(const Settings& settings, const sgm_grammar* grammar);

}  // namespace sgm_godot
