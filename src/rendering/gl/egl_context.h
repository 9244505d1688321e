#pragma once

namespace stackabilization::detail {

/// An OpenGL 3.2 core context without a window, a display server or special rights, created through EGL:
/// Mesa's surfaceless platform first, then the first usable device, then EGL's default display (which reaches
/// the X server of xvfb-run). Private to rendering/; use one context from one thread at a time.
class EglContext {
 public:
  /// Creates the context and makes it current. Throws RenderError when no platform can give one.
  EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  void make_current() const;
  bool is_current() const;

 private:
  void* display_ = nullptr;  ///< borrowed: displays live as long as the process
  void* surface_ = nullptr;  ///< 1 x 1 pixel; drawing happens in framebuffer objects
  void* context_ = nullptr;
};

}  // namespace stackabilization::detail
