#include "session.h"

#include <algorithm>
#include <cmath>

#include "files.h"
#include "godot/log.h"
#include "number_text.h"
#include "plugin.h"

namespace sgm_godot {
namespace {

constexpr const char* kBackendNames[] = {"auto", "CPU", "Vulkan", "CUDA"};

/// The level of detail whose chunks are about as large as the visible part of the world.
int32_t topLevelFor(double view_distance, int32_t cell_units) {
  const double chunk = static_cast<double>(cell_units) * SGM_CHUNK_CELLS / SGM_UNITS_PER_METRE;
  return static_cast<int32_t>(std::clamp(std::floor(std::log2(view_distance / chunk)), 0.0, double{SGM_MAX_LEVEL}));
}

/// Returns a message about lengths in the settings that are out of range; empty if all are valid.
std::string wrongDistances(const Settings& settings) {
  std::string wrong;
  const auto look = [&](const char* name, double metres) {
    if (std::isfinite(metres) && metres > 0) return;
    wrong += std::string(wrong.empty() ? "" : ", ") + name + " is " + numberText(metres) + " m";
  };
  look("cell_size", settings.cell_size);
  look("finest_distance", settings.finest_distance);
  look("view_distance", settings.view_distance);
  if (settings.collision) look("collision_distance", settings.collision_distance);
  return wrong.empty() ? wrong : wrong + ": distances have to be above 0";
}

}  // namespace

std::shared_ptr<Session> Session::create(Plugin& plugin, const GrammarOwner& grammar, const Settings& settings,
                                         std::string& failure) {
  std::shared_ptr<Session> session(new Session(plugin));
  sgm_error error = SGM_ERROR_INIT;
  failure = wrongDistances(settings);
  if (!failure.empty()) return nullptr;
  if (sgm_cell_from_metres(settings.cell_size, &session->cell_units_, &error) < SGM_OK) {
    failure = std::string("cell_size: ") + error.message;
    return nullptr;
  }
  session->grammar_ = grammar;
  session->chooseBackend(settings.backend);
  session->tellOfParameters(grammar, settings);
  Failure failed = session->makeField(grammar, settings, session->field_);
  if (!failed) failed = session->makeWorld(settings);
  if (failed) {
    failure = *failed;
    return nullptr;
  }
  return session;
}

Session::~Session() {
  // shared_ptr, because std::function requires a copyable object.
  std::shared_ptr<sgm_world> world(world_.release(), EndWith<sgm_world_destroy>());
  std::shared_ptr<sgm_field> field(field_.release(), EndWith<sgm_field_destroy>());
  if (!world) return;
  sgm_world_set_viewers(world.get(), nullptr, 0, 0, nullptr);
  sgm_world_cancel(world.get());
  plugin_.background->run([world = std::move(world), field = std::move(field), grammar = grammar_]() mutable {
    world.reset();
    field.reset();
    grammar.reset();
  });
}

void Session::chooseBackend(int64_t wanted) {
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  sgm_error error = SGM_ERROR_INIT;
  wanted = std::clamp<int64_t>(wanted, SGM_BACKEND_AUTO, SGM_BACKEND_CUDA);
  backend_ = static_cast<sgm_backend>(wanted);
  if (sgm_backend_query(plugin_.runtime, backend_, &info, &error) < SGM_OK || info.usable == 0) {
    const std::string reason = info.reason[0] != 0 ? info.reason : error.message;
    backend_ = SGM_BACKEND_AUTO;
    info = SGM_BACKEND_INFO_INIT;
    sgm_backend_query(plugin_.runtime, backend_, &info, nullptr);
    logWarning(std::string("the backend ") + kBackendNames[wanted] + " cannot be used here (" + reason +
               "); SG+M goes on with " + info.name);
  }
  backend_ = info.backend;
  backend_name_ = info.name;
  device_ = info.device;
}

void Session::tellOfParameters(const GrammarOwner& grammar, const Settings& settings) {
  for (const auto& [name, value] : settings.parameters) {
    std::string known, message;
    bool found = false;
    for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar.get()) && !found; ++i) {
      sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
      if (sgm_grammar_parameter(grammar.get(), i, &info) != SGM_OK) continue;
      known += (known.empty() ? "" : ", ") + std::string(info.name);
      found = name == info.name;
      if (!found || (value >= info.minimum && value <= info.maximum)) continue;
      message = "the parameter " + name + " is " + numberText(value) + "; it may be from " + numberText(info.minimum) +
                " to " + numberText(info.maximum) + ", and the nearest counts";
    }
    if (!found) message = "the grammar has no parameter '" + name + "'; it has " + (known.empty() ? "none" : known);
    if (!message.empty() && told_.insert(message).second) logWarning("SgmWorld3D: " + message);
  }
}

Failure Session::makeField(const GrammarOwner& grammar, const Settings& settings, FieldOwner& field) const {
  sgm_error error = SGM_ERROR_INIT;
  sgm_parameters* raw = nullptr;
  if (sgm_parameters_create(grammar.get(), &raw, &error) < SGM_OK) return error.message;
  const ParametersOwner parameters(raw);
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar.get()); ++i) {
    sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
    if (sgm_grammar_parameter(grammar.get(), i, &info) != SGM_OK) continue;
    const auto chosen = settings.parameters.find(info.name);
    if (chosen == settings.parameters.end()) continue;
    // The parameter's range may have become narrower since the value was chosen.
    double value = std::clamp(chosen->second, info.minimum, info.maximum);
    if (info.whole != 0) value = std::round(value);
    if (sgm_parameters_set(parameters.get(), info.name, value, &error) < SGM_OK) return error.message;
  }
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar.get();
  desc.parameters = parameters.get();
  desc.seed = static_cast<uint64_t>(settings.seed);
  desc.cell_units = cell_units_;
  desc.backend = backend_;
  sgm_field* made = nullptr;
  if (sgm_field_create(plugin_.runtime, &desc, &made, &error) < SGM_OK) return textOf(error);
  field.reset(made);
  return std::nullopt;
}

Failure Session::makeWorld(const Settings& settings) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  top_level_ = settings.coarsest_level >= 0
                   ? static_cast<int32_t>(std::min<int64_t>(settings.coarsest_level, SGM_MAX_LEVEL))
                   : topLevelFor(settings.view_distance, cell_units_);
  desc.top_level = top_level_;
  desc.flags = SGM_WORLD_TEXTURE | (settings.morph ? uint32_t{SGM_WORLD_MORPH} : 0u) |
               (settings.by_distance ? uint32_t{SGM_WORLD_BY_DISTANCE} : 0u) |
               (settings.sharp ? uint32_t{SGM_WORLD_SHARP} : 0u) |
               (settings.measure ? uint32_t{SGM_WORLD_MEASURE} : 0u);
  desc.finest_distance = settings.finest_distance;
  desc.view_distance = settings.view_distance;
  desc.mesh_bytes = static_cast<uint64_t>(std::max<int64_t>(settings.mesh_memory, 1)) << 20;
  desc.collider_distance = settings.collision ? settings.collision_distance : 0;
  makeFolderOf(settings.journal);
  const std::string journal = systemPath(settings.journal), cache = systemPath(settings.cache_folder);
  if (!journal.empty()) desc.journal = journal.c_str();
  if (!cache.empty()) desc.cache_folder = cache.c_str();
  std::vector<std::string> places;
  // The inspector adds a new element as an empty text, which is skipped.
  for (const std::string& store : settings.stores) {
    if (!store.empty()) places.push_back(systemPath(store));
  }
  std::vector<const char*> stores;
  for (const std::string& place : places) stores.push_back(place.c_str());
  desc.stores = stores.data();
  desc.store_count = static_cast<uint32_t>(stores.size());
  sgm_world* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_create(field_.get(), &desc, &made, &error) < SGM_OK) return error.message;
  world_.reset(made);
  return std::nullopt;
}

Failure Session::set(const GrammarOwner& grammar, const Settings& settings) {
  tellOfParameters(grammar, settings);
  FieldOwner next;
  if (Failure failed = makeField(grammar, settings, next)) return failed;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_set_field(world_.get(), next.get(), &error) < SGM_OK) return error.message;
  field_ = std::move(next);
  grammar_ = grammar;
  return std::nullopt;
}

Failure Session::update(uint64_t max_bytes, std::vector<sgm_world_event>& events) {
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_update(world_.get(), max_bytes, &error) < SGM_OK) return error.message;
  return poll(events);
}

Failure Session::poll(std::vector<sgm_world_event>& events) {
  sgm_error error = SGM_ERROR_INIT;
  for (;;) {
    sgm_world_event batch[64];
    size_t count = std::size(batch);
    if (sgm_world_poll(world_.get(), batch, 0, &count, &error) < SGM_OK) return error.message;
    if (count == 0) return std::nullopt;
    events.insert(events.end(), batch, batch + count);
  }
}

std::vector<sgm_drawn_chunk> Session::drawn() const {
  std::vector<sgm_drawn_chunk> chunks;
  size_t count = 0;
  sgm_world_get_drawn(world_.get(), nullptr, 0, &count, nullptr);
  // The number of chunks may grow between the call that returns it and the call that fills the buffer, so the buffer
  // has room for some more.
  do {
    chunks.resize(count + 16);
    count = chunks.size();
  } while (sgm_world_get_drawn(world_.get(), chunks.data(), 0, &count, nullptr) == SGM_INCOMPLETE);
  chunks.resize(count);
  return chunks;
}

}  // namespace sgm_godot
