#include "tools/preview/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace sgm::preview {
namespace {

// Number of frames that are drawn after an event, because Dear ImGui reacts to some events one or two frames later.
constexpr int kSettlingFrames = 3;
// Maximum movement of the pointer between press and release that still counts as a click, in pixels.
constexpr double kStill = 4;

std::string reason() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description != nullptr ? description : "no reason was given";
}

}  // namespace

/// The OpenGL 1.1 functions that show the picture. They are loaded at run time, so that the program also starts on
/// machines without OpenGL.
struct Window::PictureCalls {
  decltype(&glGenTextures) gen_textures = nullptr;
  decltype(&glDeleteTextures) delete_textures = nullptr;
  decltype(&glBindTexture) bind_texture = nullptr;
  decltype(&glTexParameteri) tex_parameter = nullptr;
  decltype(&glTexImage2D) tex_image = nullptr;
  decltype(&glGetIntegerv) get_integer = nullptr;
  decltype(&glViewport) viewport = nullptr;
  decltype(&glClearColor) clear_colour = nullptr;
  decltype(&glClear) clear = nullptr;

  bool load() {
    const auto found = [](auto& call, const char* name) {
      call = reinterpret_cast<std::remove_reference_t<decltype(call)>>(glfwGetProcAddress(name));
      return call != nullptr;
    };
    return found(gen_textures, "glGenTextures") && found(delete_textures, "glDeleteTextures") &&
           found(bind_texture, "glBindTexture") && found(tex_parameter, "glTexParameteri") &&
           found(tex_image, "glTexImage2D") && found(get_integer, "glGetIntegerv") && found(viewport, "glViewport") &&
           found(clear_colour, "glClearColor") && found(clear, "glClear");
  }
};

struct Window::State {
  GLFWwindow* window = nullptr;
  bool imgui = false;
  PictureCalls gl;
  GLuint texture = 0;
  int picture_width = 0, picture_height = 0;
  int frames_due = kSettlingFrames;
  Mouse mouse;
  ImVec2 pressed_at{0, 0};
  std::array<bool, 26> held{}, pressed{};

  State() = default;
  State(const State&) = delete;
  ~State() {
    if (texture != 0) gl.delete_textures(1, &texture);
    if (imgui) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }

  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
  static void stir(GLFWwindow* window) { of(window).frames_due = kSettlingFrames; }

  void closeSoon() const { glfwSetWindowShouldClose(window, GLFW_TRUE); }

  void listen() {
    glfwSetWindowUserPointer(window, this);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { stir(w); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { stir(w); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { stir(w); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { stir(w); });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { stir(w); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { stir(w); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { stir(w); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
      State& state = of(w);
      stir(w);
      if (key == GLFW_KEY_ESCAPE && !ImGui::GetIO().WantTextInput) state.closeSoon();
      if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return;
      const auto letter = static_cast<size_t>(key - GLFW_KEY_A);
      state.held[letter] = action != GLFW_RELEASE;
      if (action == GLFW_PRESS && !ImGui::GetIO().WantTextInput) state.pressed[letter] = true;
    });
  }

  /// Top left corner and size of the picture, in window coordinates.
  std::array<ImVec2, 2> place() const {
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    if (picture_width == 0 || picture_height == 0) return {ImVec2(0, 0), all};
    const float w = static_cast<float>(picture_width), h = static_cast<float>(picture_height);
    const float scale = std::min(all.x / w, all.y / h);
    const ImVec2 size(w * scale, h * scale);
    return {ImVec2((all.x - size.x) / 2, (all.y - size.y) / 2), size};
  }

  void readMouse() {
    const ImGuiIO& io = ImGui::GetIO();
    const auto [corner, size] = place();
    const Mouse before = mouse;
    mouse.x = double{io.MousePos.x - corner.x} / std::max(double{size.x}, 1.0);
    mouse.y = double{io.MousePos.y - corner.y} / std::max(double{size.y}, 1.0);
    const bool inside = mouse.x >= 0 && mouse.x < 1 && mouse.y >= 0 && mouse.y < 1;
    mouse.over_picture = inside && !io.WantCaptureMouse;
    mouse.moved_x = ImGui::IsMousePosValid() ? double{io.MouseDelta.x} / std::max(double{size.x}, 1.0) : 0;
    mouse.moved_y = ImGui::IsMousePosValid() ? double{io.MouseDelta.y} / std::max(double{size.y}, 1.0) : 0;
    mouse.wheel = mouse.over_picture ? double{io.MouseWheel} : 0;
    if (io.MouseClicked[0] && mouse.over_picture) pressed_at = io.MousePos;
    mouse.left = io.MouseDown[0] && (before.left || (io.MouseClicked[0] && mouse.over_picture));
    mouse.right = io.MouseDown[1] && (before.right || (io.MouseClicked[1] && mouse.over_picture));
    mouse.clicked = before.left && !io.MouseDown[0] && std::abs(double{io.MousePos.x - pressed_at.x}) <= kStill &&
                    std::abs(double{io.MousePos.y - pressed_at.y}) <= kStill;
  }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() = default;

Result<std::unique_ptr<Window>> Window::open(const std::string& title, int width, int height) {
  const auto failed = [](const std::string& what) {
    return Error{Code::unsupported, what + " (" + reason() +
                                        "): start it on a desktop, or draw a picture with `sgm render FILE --out "
                                        "picture.png`, which needs no display"};
  };
  glfwSetErrorCallback(nullptr);
  if (glfwInit() != GLFW_TRUE) return failed("there is no display to open a window on");
  auto state = std::make_unique<State>();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  state->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) return failed("the display cannot open a window with OpenGL 3.2");
  glfwMakeContextCurrent(state->window);
  if (!state->gl.load()) return failed("the display's OpenGL is incomplete");
  glfwSwapInterval(1);
  state->listen();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // null: Dear ImGui must not write its settings file into the current folder
  ImGui::StyleColorsDark();
  state->imgui = ImGui_ImplGlfw_InitForOpenGL(state->window, true);
  if (!state->imgui || !ImGui_ImplOpenGL3_Init("#version 150")) return failed("the display's OpenGL is incomplete");
  return std::unique_ptr<Window>(new Window(std::move(state)));
}

bool Window::isClosed() const { return glfwWindowShouldClose(state_->window) != 0; }
void Window::refresh() { state_->frames_due = kSettlingFrames; }

void Window::wait(double seconds) {
  if (state_->frames_due > 0)
    glfwPollEvents();
  else
    glfwWaitEventsTimeout(seconds);
}

Result<void> Window::show(const Image& image) {
  State& state = *state_;
  GLint most = 0;
  state.gl.get_integer(GL_MAX_TEXTURE_SIZE, &most);
  if (image.width > most || image.height > most)
    return Error{Code::unsupported, "the display can show pictures of at most " + std::to_string(most) +
                                        " pixels on a side: choose a smaller --size"};
  if (state.texture == 0) state.gl.gen_textures(1, &state.texture);
  state.gl.bind_texture(GL_TEXTURE_2D, state.texture);
  state.gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  state.gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  state.gl.tex_image(GL_TEXTURE_2D, 0, GL_RGBA, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     image.rgba.data());
  state.picture_width = image.width;
  state.picture_height = image.height;
  refresh();
  return {};
}

void Window::draw(const std::function<void()>& controls) {
  State& state = *state_;
  if (state.frames_due == 0) return;
  --state.frames_due;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  state.readMouse();
  if (state.texture != 0) {
    const auto [corner, size] = state.place();
    ImGui::GetBackgroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(state.texture)),
                                             corner, ImVec2(corner.x + size.x, corner.y + size.y));
  }
  controls();
  state.pressed.fill(false);
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(state.window, &width, &height);
  state.gl.viewport(0, 0, width, height);
  state.gl.clear_colour(0.06f, 0.06f, 0.07f, 1);
  state.gl.clear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(state.window);
}

Mouse Window::mouse() const { return state_->mouse; }

bool Window::isHeld(char letter) const {
  return state_->held[static_cast<size_t>(letter - 'A')] && !ImGui::GetIO().WantTextInput;
}
bool Window::isPressed(char letter) const { return state_->pressed[static_cast<size_t>(letter - 'A')]; }

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return width;
}
int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return height;
}

}  // namespace sgm::preview
