#pragma once

#include <memory>

namespace sgm_godot {

/// As a member, tells whether the object that contains it still exists. A function that runs scripts, which may destroy
/// the object, calls watch() before, and checks the watch before it uses the object again.
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
