#pragma once
// A window with a picture and controls on it.

#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "tools/render/image.h"

namespace sgm::preview {

/// Where the mouse is, and what it has done since the frame before. Places and ways are in shares of the picture: 0..1
/// from its top left corner.
struct Mouse {
  double x = 0, y = 0;
  bool over_picture = false;  ///< and not over a control
  double moved_x = 0, moved_y = 0;
  bool left = false, right = false;  ///< held, since a press over the picture
  bool clicked = false;              ///< the left button went up where it had gone down
  double wheel = 0;                  ///< steps away from the user
};

/// One window at a time; all functions on the thread that opened it, which must be the process's first.
class Window {
 public:
  /// Errors: unsupported, where there is no display or no OpenGL, with what to do.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width, int height);
  ~Window();

  /// Its user has closed it, by its button or by Escape.
  bool isClosed() const;
  /// Returns when something has happened to the window, or after so many seconds.
  void wait(double seconds);
  /// The picture from now on; it is scaled to the window, but never stretched. Error: unsupported, for its size.
  Result<void> show(const Image& image);
  /// Draws the picture, and on it what `controls` asks Dear ImGui for. Nothing where nothing has changed.
  void draw(const std::function<void()>& controls);
  /// Something has changed that the window cannot know of: the next frames are drawn.
  void refresh();

  Mouse mouse() const;
  /// A letter's key, in capitals, is held; false while text is written into a control.
  bool isHeld(char letter) const;
  /// It went down since the frame before.
  bool isPressed(char letter) const;
  /// Of the part that shows a picture, pixels.
  int width() const;
  int height() const;

 private:
  struct PictureCalls;
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sgm::preview
