#include "rendering/gl/offscreen_window.h"

#include <EGL/egl.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkTextureObject.h>
#include <vtkVersionMacros.h>

#include <string>
#include <string_view>

#include "rendering/gl/egl_context.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {
namespace {

// Debian's GLEW is built for GLX. Under EGL it loads every OpenGL function and only then complains that it
// found no GLX display; VTK repeats that complaint at each frame although all is well.
bool is_harmless(std::string_view message) {
  return message.find("GLEW could not be initialized") != std::string_view::npos;
}

}  // namespace

struct OffscreenWindow::Data {
  EglContext context;  // outlives the window, whose destructor releases OpenGL objects
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkCallbackCommand> observer;
  std::string error;

  Data();
  ~Data() {
    context.make_current();
    window->Finalize();
  }

  static void on_event(vtkObject* sender, unsigned long event, void* self, void* argument);
};

void OffscreenWindow::Data::on_event(vtkObject*, unsigned long event, void* self, void* argument) {
  Data& data = *static_cast<Data*>(self);
  if (event == vtkCommand::WindowMakeCurrentEvent) data.context.make_current();
  if (event == vtkCommand::WindowIsCurrentEvent) *static_cast<bool*>(argument) = data.context.is_current();
  if (event == vtkCommand::ErrorEvent && argument != nullptr) {
    const std::string message = static_cast<const char*>(argument);
    if (!is_harmless(message) && data.error.empty()) data.error = message;
  }
}

OffscreenWindow::Data::Data() {
  observer->SetClientData(this);
  observer->SetCallback(&Data::on_event);
  for (const unsigned long event :
       {vtkCommand::WindowMakeCurrentEvent, vtkCommand::WindowIsCurrentEvent, vtkCommand::ErrorEvent})
    window->AddObserver(event, observer);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  window->SetOpenGLSymbolLoader([](void*, const char* name) { return eglGetProcAddress(name); }, nullptr);
#endif
  window->SetIsCurrent(true);
  window->SetReadyForRendering(true);
  window->SetSupportsOpenGL(true);
  window->SetMultiSamples(0);
  window->SetFrameBlitModeToNoBlit();
  window->InitializeFromCurrentContext();
  window->SetSize(1, 1);
  window->Render();  // the state cache of VTK answers questions about the driver only after a first frame
}

OffscreenWindow::OffscreenWindow(int width, int height) : data_(std::make_unique<Data>()) {
  resize(width, height);
}
OffscreenWindow::OffscreenWindow(OffscreenWindow&&) noexcept = default;
OffscreenWindow& OffscreenWindow::operator=(OffscreenWindow&&) noexcept = default;
OffscreenWindow::~OffscreenWindow() = default;

vtkRenderWindow& OffscreenWindow::vtk() {
  return *data_->window;
}

void OffscreenWindow::resize(int width, int height) {
  data_->window->SetSize(width, height);
}

int OffscreenWindow::maximal_side() {
  data_->context.make_current();
  const int side = vtkTextureObject::GetMaximumTextureSize(data_->window);
  if (side < 1) throw RenderError("the OpenGL driver does not say how large a picture it can draw");
  return side;
}

void OffscreenWindow::render() {
  data_->context.make_current();
  data_->window->Render();
  if (!data_->error.empty()) throw RenderError("OpenGL rendering failed: " + data_->error);
}

}  // namespace stackabilization::detail
