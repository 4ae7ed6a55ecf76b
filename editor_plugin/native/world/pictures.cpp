#include "world/pictures.h"

#include <utility>

namespace sgm_godot {

std::unique_ptr<Picture> Pictures::take() {
  const bool empty = current_ == nullptr || current_->counts().chunks == 0;
  return empty && previous_ != nullptr ? std::move(previous_) : std::move(current_);
}

std::unique_ptr<Picture> Pictures::create(Look look) const {
  look.slots = materials_.slots();
  look.materials = materials_.rids();
  return std::make_unique<Picture>(plugin_, std::move(look));
}

void Pictures::begin(std::unique_ptr<Picture> previous, const Paint& paint, Look look) {
  previous_ = std::move(previous);
  previous_materials_ = materials_;
  materials_.rebuild(plugin_, paint.names, paint.settings);
  current_ = create(std::move(look));
}

void Pictures::clear() {
  current_.reset();
  previous_.reset();
}

void Pictures::repaint(const Paint& paint) {
  materials_.rebuild(plugin_, paint.names, paint.settings);
  current_->setMaterials(materials_.rids());
}

void Pictures::repack(const Paint& paint, Look look, const Session& session) {
  previous_materials_ = materials_;
  materials_.rebuild(plugin_, paint.names, paint.settings);
  std::unique_ptr<Picture> next = create(std::move(look));
  next->takeDrawn(session.drawn(), *current_);
  if (previous_ == nullptr || current_->counts().chunks != 0) previous_ = std::move(current_);
  current_ = std::move(next);
}

void Pictures::setLook(const Look& look) {
  current_->setLook(look.shadow, look.visible, look.layers);
  if (previous_) previous_->setLook(look.shadow, look.visible, look.layers);
}

void Pictures::setPlacement(const Placement& placement) {
  current_->setPlacement(placement);
  if (previous_) previous_->setPlacement(placement);
}

}  // namespace sgm_godot
