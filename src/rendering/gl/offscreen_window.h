#pragma once

#include <memory>

class vtkRenderWindow;

namespace stackabilization::detail {

/// A VTK render window without a display: an EGL context under vtkGenericOpenGLRenderWindow. VTK's own
/// windows abort the process when there is no X server; this class throws. For a single thread.
class OffscreenWindow {
 public:
  /// Creates a window, sizes in pixels, > 0. Throws RenderError when there is no OpenGL context.
  OffscreenWindow(int width, int height);
  OffscreenWindow(OffscreenWindow&&) noexcept;
  OffscreenWindow& operator=(OffscreenWindow&&) noexcept;
  ~OffscreenWindow();

  vtkRenderWindow& vtk();
  void resize(int width, int height);
  /// Returns the largest side that can be rendered at once, pixels.
  int maximal_side();
  /// Renders all renderers. Throws RenderError with VTK's message when VTK reports an error.
  void render();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace stackabilization::detail
