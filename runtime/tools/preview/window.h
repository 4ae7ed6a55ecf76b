#pragma once
// A window with a picture and controls.

#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/render/image.h"

namespace sgm::preview {

/// The state of the mouse, and its changes since the previous frame. Positions and distances are shares of the
/// picture's size: 0..1 from its top left corner.
struct Mouse {
  double x = 0, y = 0;
  bool over_picture = false;  ///< the pointer is over the picture, not over a control
  double moved_x = 0, moved_y = 0;
  bool left = false, right = false;  ///< the button is held since it was pressed over the picture
  bool clicked = false;              ///< the left button was released at the point where it was pressed
  double wheel = 0;                  ///< steps of the wheel; positive: away from the user
};

/// Only one window may exist at a time. All functions must be called in the thread that opened it, the process's main
/// thread.
class Window {
 public:
  /// Error: unsupported if there is no display or no OpenGL; the message says what to install or set.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width, int height);
  ~Window();

  /// Whether the user has closed the window by its button or by Escape.
  bool isClosed() const;
  /// Returns after the next event of the window, or after `seconds`.
  void wait(double seconds);
  /// Replaces the picture, which is scaled to the window without distortion. Error: unsupported if the picture is too
  /// large.
  Result<void> show(const Image& image);
  /// Draws the picture and the controls of Dear ImGui. Does nothing if neither has changed.
  void draw(const std::function<void()>& controls);
  /// Forces the next frames to be drawn. Needed after changes that the window cannot detect.
  void refresh();

  Mouse mouse() const;
  /// Whether the key of a capital letter is held; false while the user types into a control.
  bool isHeld(char letter) const;
  /// Whether the key was pressed since the previous frame.
  bool isPressed(char letter) const;
  /// Size of the window's area for the picture, in pixels.
  int width() const;
  int height() const;

 private:
  struct PictureCalls;
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sgm::preview
