#pragma once

#include <memory>

namespace sgm_godot {

/// A member of this type lets functions find out whether the object that contains it still exists. A function that runs
/// scripts calls watch() first, because scripts may destroy the object; afterwards it checks the watch before it uses
/// the object.
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
