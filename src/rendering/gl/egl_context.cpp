#include "rendering/gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <vector>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {
namespace {

constexpr const char* no_context =
    "no OpenGL context: install libegl1 and libgl1-mesa-dri or run under xvfb-run";

template <typename Function>
Function entry_point(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool has_client_extension(std::string_view name) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

/// Displays to try, best first. None of them is initialised yet.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  const auto platform_display = entry_point<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (platform_display != nullptr && has_client_extension("EGL_MESA_platform_surfaceless"))
    displays.push_back(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  const auto query_devices = entry_point<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (platform_display != nullptr && query_devices != nullptr &&
      has_client_extension("EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE)
      for (EGLint i = 0; i < count; ++i)
        displays.push_back(
            platform_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
  }
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

struct Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;
};

void destroy(const Handles& handles) {
  if (handles.context != EGL_NO_CONTEXT) eglDestroyContext(handles.display, handles.context);
  if (handles.surface != EGL_NO_SURFACE) eglDestroySurface(handles.display, handles.surface);
}

/// Context on one display, made current; no context when the display cannot give one.
Handles context_on(EGLDisplay display) {
  Handles handles;
  handles.display = display;
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) != EGL_TRUE) return handles;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return handles;
  constexpr std::array<EGLint, 15> wanted{EGL_SURFACE_TYPE,
                                          EGL_PBUFFER_BIT,
                                          EGL_RED_SIZE,
                                          8,
                                          EGL_GREEN_SIZE,
                                          8,
                                          EGL_BLUE_SIZE,
                                          8,
                                          EGL_ALPHA_SIZE,
                                          8,
                                          EGL_DEPTH_SIZE,
                                          24,
                                          EGL_RENDERABLE_TYPE,
                                          EGL_OPENGL_BIT,
                                          EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) return handles;
  constexpr std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                          3,
                                          EGL_CONTEXT_MINOR_VERSION,
                                          2,
                                          EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                          EGL_NONE};
  handles.surface = eglCreatePbufferSurface(display, config, size.data());
  handles.context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
  if (handles.context != EGL_NO_CONTEXT &&
      eglMakeCurrent(display, handles.surface, handles.surface, handles.context) == EGL_TRUE)
    return handles;
  destroy(handles);
  return {};
}

}  // namespace

EglContext::EglContext() {
  for (const EGLDisplay display : candidate_displays()) {
    const Handles handles = context_on(display);
    if (handles.context == EGL_NO_CONTEXT) continue;
    display_ = handles.display;
    surface_ = handles.surface;
    context_ = handles.context;
    return;
  }
  throw RenderError(no_context);
}

EglContext::~EglContext() {
  if (is_current()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  destroy({display_, surface_, context_});
}

void EglContext::make_current() const {
  if (is_current()) return;
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display_, surface_, surface_, context_) != EGL_TRUE) throw RenderError(no_context);
}

bool EglContext::is_current() const {
  return eglGetCurrentContext() == context_;
}

}  // namespace stackabilization::detail
