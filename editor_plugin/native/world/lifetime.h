#pragma once

#include <memory>

namespace sgm_godot {

/// Whether the object that has it as a member still exists. A function that runs scripts, which may end the object,
/// takes a watch before, and reads the watch alone afterwards.
class Lifetime {
 public:
  Lifetime() = default;
  ~Lifetime() { *exists_ = false; }
  Lifetime(const Lifetime&) = delete;
  Lifetime& operator=(const Lifetime&) = delete;

  std::shared_ptr<const bool> watch() const { return exists_; }

 private:
  std::shared_ptr<bool> exists_ = std::make_shared<bool>(true);
};

}  // namespace sgm_godot
