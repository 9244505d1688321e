#pragma once

#include <memory>

class vtkRenderWindow;

namespace stackabilization::detail {

/// A VTK render window that needs no display: an EGL context under vtkGenericOpenGLRenderWindow. VTK's own
/// windows abort the process when there is no X server; this one throws. Private to rendering/;
/// single-threaded use.
class OffscreenWindow {
 public:
  /// Throws RenderError when there is no OpenGL context. Sizes in pixels, > 0.
  OffscreenWindow(int width, int height);
  OffscreenWindow(OffscreenWindow&&) noexcept;
  OffscreenWindow& operator=(OffscreenWindow&&) noexcept;
  ~OffscreenWindow();

  vtkRenderWindow& vtk();
  void resize(int width, int height);
  /// Largest side that can be rendered at once, pixels.
  int maximal_side();
  /// Draws all renderers. Throws RenderError with VTK's own words when it reports an error.
  void render();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace stackabilization::detail
