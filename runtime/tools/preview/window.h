#pragma once
// A window that shows a picture and controls.

#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/render/image.h"

namespace sgm::preview {

/// The state of the mouse, and its changes since the previous frame. Positions and movements are fractions of the size
/// of the picture: 0..1 from its top left corner.
struct Mouse {
  double x = 0, y = 0;
  bool over_picture = false;  ///< true if the pointer is over the picture, not over a control
  double moved_x = 0, moved_y = 0;
  bool left = false, right = false;  ///< true while the mouse button is held, if it was pressed over the picture
  bool clicked = false;              ///< true if the left button was released at the point where it was pressed
  double wheel = 0;                  ///< steps of the wheel; positive if rolled away from the user
};

/// The window of the preview. Only one may exist at a time. All functions must be called in the main thread of the
/// process.
class Window {
 public:
  /// Opens the window. Error: unsupported if there is no display or no OpenGL; the message says what to install or set.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width, int height);
  ~Window();

  /// Whether the user has closed the window with its close button or Escape.
  bool isClosed() const;
  /// Waits for the next event of the window, at most `seconds`.
  void wait(double seconds);
  /// Replaces the picture. It is scaled to the window without distortion. Error: unsupported if the picture is too
  /// large.
  Result<void> show(const Image& image);
  /// Draws the picture and the Dear ImGui controls. Does nothing if neither has changed. controls: called to define the
  /// controls.
  void draw(const std::function<void()>& controls);
  /// Makes draw() draw the next few frames, even if picture and controls seem unchanged. Call it after changes that the
  /// window cannot detect.
  void refresh();

  Mouse mouse() const;
  /// Whether the key of `letter` (A to Z) is held down; always false while the user types into a control.
  bool isHeld(char letter) const;
  /// Whether the key of `letter` (A to Z) was pressed since the previous frame.
  bool isPressed(char letter) const;
  /// Size of the area of the window that shows the picture, in pixels.
  int width() const;
  int height() const;

 private:
  struct PictureCalls;
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sgm::preview
