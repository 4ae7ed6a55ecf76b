#pragma once
// Flies through a streamed world: makes an engine's calls in each frame, and checks some of the pictures.

#include <sgm/sgm.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>

#include "../embed/handles.h"
#include "frames.h"
#include "scene.h"
#include "uploaded_path.h"
#include "view_point.h"
#include "vulkan_device.h"

/// World and device must outlive the flight.
class Flight {
 public:
  /// closed: the world is rock without end, so that a camera in its void must see a surface in every pixel.
  Flight(VulkanDevice& device, const ChunkPipeline& pipeline, sgm_world* world, bool closed)
      : world_(world),
        closed_(closed),
        aspect_(double{1} * pipeline.size().width / pipeline.size().height),
        scene_(device),
        frames_(device, pipeline, kInFlight),
        uploaded_(device, pipeline) {}

  /// Streams the world without drawing, as a loading screen does, until everything visible from the view is ready.
  void load(const ViewPoint& view) {
    look(view);
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_world_wait_idle(world_, nullptr, nullptr, &error), error);
    poll();
  }

  void frame(const ViewPoint& view) {
    look(view);
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_world_update(world_, kBytesPerFrame, &error), error);
    poll();
    draw(view);
  }

  void draw(const ViewPoint& view) {
    scene_.release(frames_.ended());
    drawn_ = scene_.drawList(view.units());
    frames_.draw(drawn_, view.matrix(aspect_));
  }

  /// Draws the last frame again from uploaded buffers, and requires the same picture, byte for byte. loaded: true if
  /// load() was called for this view, so that the camera has fine chunks around it. Otherwise it may be at a place
  /// where only coarse chunks are drawn.
  Picture check(const ViewPoint& view, bool loaded) {
    const Picture picture = frames_.picture();
    const Picture other = uploaded_.draw(world_, drawn_, view.units(), view.matrix(aspect_));
    const std::string frame = "frame " + std::to_string(frames_.submitted()) + ": ";
    if (const size_t pixels = picture.differences(other); pixels > 0) {
      throw std::runtime_error(frame + std::to_string(pixels) + " pixels differ from those of uploaded meshes");
    }
    const size_t uncovered = picture.uncovered();
    if (uncovered == picture.pixels()) throw std::runtime_error(frame + "nothing is to be seen");
    if (closed_ && loaded && uncovered > 0) {
      throw std::runtime_error(frame + "holes of " + std::to_string(uncovered) + " pixels in the rock");
    }
    ++compared_;
    return picture;
  }

  uint64_t frames() const { return frames_.submitted(); }
  size_t compared() const { return compared_; }
  const DrawList& drawn() const { return drawn_; }  ///< the draw list of the last frame
  const Scene& scene() const { return scene_; }

 private:
  static constexpr size_t kInFlight = 3;
  static constexpr uint64_t kBytesPerFrame = 4 << 20;

  void look(const ViewPoint& view) {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    for (size_t axis = 0; axis < 3; ++axis) {
      viewer.position[axis] = view.at[axis];
      viewer.direction[axis] = static_cast<float>(view.forward[axis]);
    }
    viewer.fov = ViewPoint::kFov;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_world_set_viewers(world_, &viewer, 0, 1, &error), error);
  }

  /// Processes all pending events; then the drawn surface has no gaps.
  void poll() {
    sgm_error error = SGM_ERROR_INIT;
    sgm_world_event events[64];
    for (size_t count = std::size(events); count > 0;) {
      count = std::size(events);
      must(sgm_world_poll(world_, events, 0, &count, &error), error);
      for (size_t i = 0; i < count; ++i) scene_.take(events[i], frames_.submitted());
    }
  }

  sgm_world* world_;
  bool closed_;
  double aspect_;
  Scene scene_;  // must outlive the frames, which draw its meshes
  Frames frames_;
  UploadedPath uploaded_;
  DrawList drawn_;
  size_t compared_ = 0;
};
