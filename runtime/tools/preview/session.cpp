#include "tools/preview/session.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/json.h"

namespace sgm::preview {
namespace {

using cli::gazeText;

constexpr double kLook = 0.04;    // time between two checks of the grammar files, seconds
constexpr double kRest = 0.15;    // time that the pointer must rest before the place under it is looked up, seconds
constexpr double kTurn = 3.0;     // turn of the camera for a drag across the height of the picture, radians
constexpr double kNearer = 0.85;  // factor by which each step of the mouse wheel changes the distance to the target
constexpr double kWalk = 0.6;  // speed of the camera while a key is held: share of the view's typical depth per second
constexpr double kRadians = 0.017453292519943295;

FreeCamera::Gaze gazeOf(const Painted& painted) {
  return cli::worldGaze(painted.view.camera, painted.region->meshed.mesh.origin);
}

std::string textOf(const PointedPlace& place) {
  std::string text = place.path.empty() ? "no shape is near, the domain decides" : place.path + "\n" + place.source;
  if (!place.material.empty()) text += "\n" + place.material;
  if (!place.tag.empty()) text += (place.material.empty() ? "\ntag " : ", tag ") + place.tag;
  return text + fmt::format("\n{:.2f}, {:.2f}, {:.2f} m", place.position[0], place.position[1], place.position[2]);
}

/// The word in quotes if necessary, so that a shell reads it literally.
std::string quoted(const std::string& word) {
  const bool plain = std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./,:=+").find(c) != std::string_view::npos;
  });
  if (plain && !word.empty()) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void printLine(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace

Session::Session(const cli::RenderOptions& options, Painter& painter, Window& window)
    : options_(options), painter_(painter), window_(window), controls_(options) {
  files_.watch({options.file});
}

cli::RenderOptions Session::requestedOptions() const {
  cli::RenderOptions options = options_;
  options.seed = controls_.seed();
  options.light = controls_.light();
  options.sets = controls_.sets();
  options.size =
      fmt::format("{}x{}", std::clamp(window_.width(), 16, kMaxPicture), std::clamp(window_.height(), 16, kMaxPicture));
  if (camera_) options.camera = gazeText(camera_->gaze());
  return options;
}

void Session::ask() {
  requested_ = painter_.request({requestedOptions(), edition_});
  at_work_ = true;
  place_is_known_ = false;
  window_.refresh();
}

void Session::sayPicture(const Painted& painted) const {
  if (!options_.json) return;
  Json line{{"event", painted.region ? "picture" : "message"},
            {"messages", painted.messages},
            {"seconds", painted.seconds},
            {"sets", Json(controls_.sets())},
            {"seed", controls_.seed()}};
  if (painted.region) {
    line.update({{"draft", painted.draft},
                 {"width", painted.image.width},
                 {"height", painted.image.height},
                 {"triangles", painted.region->meshed.mesh.indices.size() / 3},
                 {"camera", gazeText(gazeOf(painted))},
                 {"light", cli::lightName(painted.light)}});
  }
  printLine(line.line());
}

Result<void> Session::takeResult() {
  std::optional<Painted> painted = painter_.take();
  if (!painted) return {};
  if (!painted->files.empty()) files_.watch(painted->files);
  controls_.adopt(painted->program);
  if (painted->request == requested_ && !painted->draft) at_work_ = false;
  sayPicture(*painted);
  if (!painted->region) {
    // Keep the last picture visible, and show the new error messages next to it.
    last_.messages = painted->messages;
    window_.refresh();
    return {};
  }
  if (const Result<void> shown = window_.show(painted->image); !shown) return shown;
  painted->image = {};
  last_ = std::move(*painted);
  place_is_known_ = false;
  return {};
}

void Session::steer() {
  const Clock::time_point now = Clock::now();
  const double passed = std::min(std::chrono::duration<double>(now - frame_at_).count(), 0.1);
  frame_at_ = now;
  if (window_.isPressed('P')) sayCommand();
  if (!last_.region) return;
  if (window_.isPressed('H') && camera_) {
    camera_.reset();
    return ask();
  }
  const Mouse mouse = window_.mouse();
  const auto along = [&](char back, char forth) {
    return static_cast<double>(window_.isHeld(forth)) - static_cast<double>(window_.isHeld(back));
  };
  const double right = along('A', 'D'), ahead = along('S', 'W'), up = along('Q', 'E');
  const bool moved = mouse.moved_x != 0 || mouse.moved_y != 0;
  const bool walks = right != 0 || ahead != 0 || up != 0;
  if (!(mouse.wheel != 0 || walks || (moved && (mouse.left || mouse.right)))) return;

  if (!camera_) camera_.emplace(gazeOf(last_), last_.view.enclosed);
  const double aspect = static_cast<double>(window_.width()) / std::max(window_.height(), 1);
  if (mouse.left) camera_->turn(kTurn * aspect * mouse.moved_x, -kTurn * mouse.moved_y);
  if (mouse.right) {
    const double across = 2 * std::tan(options_.fov * kRadians / 2) * camera_->distance();
    camera_->move(-across * aspect * mouse.moved_x, across * mouse.moved_y, 0);
  }
  if (mouse.wheel != 0) camera_->approach(std::pow(kNearer, mouse.wheel));
  if (walks) {
    const double step = passed * std::max(1.0, kWalk * double{last_.view.depth});
    camera_->move(step * right, step * up, step * ahead);
  }
  ask();
}

void Session::point() {
  const Mouse mouse = window_.mouse();
  const Clock::time_point now = Clock::now();
  if (mouse.moved_x != 0 || mouse.moved_y != 0 || mouse.left || mouse.right) {
    pointer_rests_ = now;
    place_is_known_ = false;
  }
  if (mouse.clicked && mouse.over_picture) clicked_ = true;
  if (pointing_.valid()) {
    if (pointing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    const Pointed pointed = pointing_.get();
    place_ = pointed ? *pointed : std::nullopt;
    place_error_ = pointed ? std::string() : pointed.error().message;
    place_is_known_ = true;
    window_.refresh();
  }
  if (place_is_known_ && clicked_) {
    clicked_ = false;
    if (place_) say(*place_);
  }
  if (place_is_known_ || !mouse.over_picture || !last_.region || mouse.left) return;
  if (!clicked_ && std::chrono::duration<double>(now - pointer_rests_).count() < kRest) return;
  const FreeCamera::Gaze gaze = gazeOf(last_);
  const RenderCamera& camera = last_.view.camera;
  const glm::dvec3 ray = rayThrough(gaze, double{camera.fov_degrees} * kRadians,
                                    static_cast<double>(camera.width) / camera.height, mouse.x, mouse.y);
  pointing_ = std::async(std::launch::async, [region = last_.region, file = options_.file, from = gaze[0], ray] {
    return placeOnRay(*region->world, file, from, ray);
  });
}

void Session::drawPlace() {
  if (!place_is_known_ || !window_.mouse().over_picture || at_work_) return;
  if (place_) ImGui::SetTooltip("%s", textOf(*place_).c_str());
  if (!place_error_.empty()) ImGui::SetTooltip("%s", place_error_.c_str());
}

void Session::say(const PointedPlace& place) const {
  if (options_.json) {
    printLine(Json{{"event", "place"},
                   {"path", place.path},
                   {"source", place.source},
                   {"material", place.material},
                   {"tag", place.tag},
                   {"at", Json(std::vector<double>(place.position.begin(), place.position.end()))}}
                  .line());
    return;
  }
  std::string line = place.source.empty() ? std::string() : place.source + ": ";
  for (const char c : textOf(place)) line += c == '\n' ? ' ' : c;
  printLine(line);
}

void Session::sayCommand() const {
  const cli::RenderOptions options = requestedOptions();
  std::string line = "sgm render " + quoted(options.file) + " --out picture.png --size " + options.size;
  line += fmt::format(" --seed {}", options.seed);
  for (const std::string& set : options.sets) line += " --set " + quoted(set);
  if (last_.region) {
    line += fmt::format(" --region={} --cell {}", last_.box, last_.cell);
    line += " --camera=" + gazeText(gazeOf(last_));
  }
  if (options.sharp) line += " --sharp";
  line += fmt::format(" --fov {} --light {}", options.fov, options.light);
  printLine(options_.json ? Json{{"event", "command"}, {"command", line}}.line() : line);
}

Result<void> Session::run() {
  ask();
  int width = window_.width(), height = window_.height();
  Clock::time_point looked = Clock::now();
  while (!window_.isClosed()) {
    window_.wait(kLook);
    if (const Clock::time_point now = Clock::now(); std::chrono::duration<double>(now - looked).count() >= kLook) {
      looked = now;
      if (files_.changed()) {
        ++edition_;
        ask();
      }
    }
    if (const Result<void> taken = takeResult(); !taken) return taken;
    if (width != window_.width() || height != window_.height()) {
      width = window_.width();
      height = window_.height();
      ask();
    }
    bool changed = false;
    window_.draw([&] {
      changed = controls_.draw(last_, at_work_);
      drawPlace();
      steer();
      point();
    });
    // Request further frames: a resting pointer and a held key cause no events.
    if (pointing_.valid() || !place_is_known_) window_.refresh();
    for (const char key : {'W', 'A', 'S', 'D', 'Q', 'E'})
      if (window_.isHeld(key)) window_.refresh();
    if (changed) ask();
  }
  return {};
}

}  // namespace sgm::preview
