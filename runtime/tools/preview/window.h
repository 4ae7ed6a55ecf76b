#pragma once
// A window with a picture and controls.

#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/render/image.h"

namespace sgm::preview {

/// State of the mouse, and its changes since the previous frame. Places and distances are shares of the picture: 0..1
/// from its top left corner.
struct Mouse {
  double x = 0, y = 0;
  bool over_picture = false;  ///< but not over a control
  double moved_x = 0, moved_y = 0;
  bool left = false, right = false;  ///< held, since a press over the picture
  bool clicked = false;              ///< the left button was released where it was pressed
  double wheel = 0;                  ///< steps away from the user
};

/// One window at a time. All functions must be called in the thread that opened it, the process's first one.
class Window {
 public:
  /// Error: unsupported if there is no display or no OpenGL, with the remedy.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width, int height);
  ~Window();

  /// Whether the user has closed it, by its button or by Escape.
  bool isClosed() const;
  /// Returns after an event of the window, or after `seconds`.
  void wait(double seconds);
  /// Replaces the picture, which is scaled to the window without distortion. Error: unsupported, for its size.
  Result<void> show(const Image& image);
  /// Draws the picture and the controls of Dear ImGui. Does nothing if nothing has changed.
  void draw(const std::function<void()>& controls);
  /// Forces the next frames to be drawn, after changes that the window cannot detect.
  void refresh();

  Mouse mouse() const;
  /// Whether a letter's key, in capitals, is held; false while the user types into a control.
  bool isHeld(char letter) const;
  /// Whether it was pressed since the previous frame.
  bool isPressed(char letter) const;
  /// Of the picture's part of the window, pixels.
  int width() const;
  int height() const;

 private:
  struct PictureCalls;
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sgm::preview
