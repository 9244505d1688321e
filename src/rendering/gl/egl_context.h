#pragma once

namespace stackabilization::detail {

/// An OpenGL 3.2 core context without a window, a display server or special rights, created through EGL. It
/// tries Mesa's surfaceless platform, then the first usable device, then EGL's default display (the X server
/// of xvfb-run). Use a context from one thread at a time.
class EglContext {
 public:
  /// Creates the context and makes it current. Throws RenderError when no platform provides one.
  EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  void make_current() const;
  bool is_current() const;

 private:
  void* display_ = nullptr;  ///< not owned: displays live as long as the process
  void* surface_ = nullptr;  ///< 1 x 1 pixel; rendering uses framebuffer objects
  void* context_ = nullptr;
};

}  // namespace stackabilization::detail
