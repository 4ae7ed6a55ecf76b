#pragma once
// A field and the world that streams it, made from the settings of an SgmWorld3D.

#include <memory>
#include <optional>
#include <set>

#include "grammar.h"
#include "settings.h"

namespace sgm_godot {

struct Plugin;

/// A message for the user if something failed; nullopt on success.
using Failure = std::optional<std::string>;

/// A running world. It is shared, so that a measurement on another thread may outlive a restart. It is destroyed on the
/// background thread, because its destruction waits for unfinished jobs of the runtime.
class Session {
 public:
  /// Returns null if the world cannot be made; `failure` is then the reason.
  static std::shared_ptr<Session> create(Plugin& plugin, const GrammarOwner& grammar, const Settings& settings,
                                         std::string& failure);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Switches to another grammar, seed or parameters; the world replaces its chunks gradually.
  Failure set(const GrammarOwner& grammar, const Settings& settings);

  sgm_world* world() const { return world_.get(); }
  sgm_field* field() const { return field_.get(); }
  const GrammarOwner& grammar() const { return grammar_; }
  int32_t cellUnits() const { return cell_units_; }
  int32_t topLevel() const { return top_level_; }
  const std::string& backend() const { return backend_name_; }
  const std::string& device() const { return device_; }

  /// Updates the world, and appends all pending events.
  Failure update(uint64_t max_bytes, std::vector<sgm_world_event>& events);
  Failure poll(std::vector<sgm_world_event>& events);
  /// All drawn chunks; the caller releases their meshes. Thread-safe.
  std::vector<sgm_drawn_chunk> drawn() const;

 private:
  explicit Session(Plugin& plugin) : plugin_(plugin) {}
  void tellOfParameters(const GrammarOwner& grammar, const Settings& settings);
  Failure makeField(const GrammarOwner& grammar, const Settings& settings, FieldOwner& field) const;
  Failure makeWorld(const Settings& settings);
  void chooseBackend(int64_t wanted);

  Plugin& plugin_;
  GrammarOwner grammar_;
  FieldOwner field_;
  WorldOwner world_;
  int32_t cell_units_ = 0, top_level_ = 0;
  sgm_backend backend_ = SGM_BACKEND_CPU;
  std::string backend_name_, device_;
  // the warnings about parameters that were already logged, so that each is logged only once
  std::set<std::string> told_;
};

}  // namespace sgm_godot
