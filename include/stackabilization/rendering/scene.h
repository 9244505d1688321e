#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/rendering/colour.h"
#include "stackabilization/rendering/image.h"

namespace stackabilization {

/// Surface style of a mesh.
enum class Finish {
  shaded,  ///< lit, with creases and borders drawn as thin lines
  smooth,  ///< lit, no lines
  plain,   ///< one flat colour, no lines: for marks such as contact regions
};

/// A shape in a scene, in its own model coordinates.
struct SceneMesh {
  Shape shape;                     ///< model units
  std::vector<Colour> colours;     ///< one colour for the whole mesh, or one per part
  double opacity = 1;              ///< in (0, 1]
  Finish finish = Finish::shaded;  ///< surface style
};

/// Polylines of one colour and width. A polyline of one point is a dot.
struct SceneLines {
  std::vector<Points> polylines;  ///< each k x 3, model units
  Colour colour = palette::ink;   ///< colour of all polylines
  double width = 1.5;             ///< width in pixels of the final picture
};

/// Content of a 3D picture. Light, ground and framing are fixed.
struct Scene {
  std::vector<SceneMesh> meshes;  ///< meshes, with hidden surfaces removed
  std::vector<SceneLines> lines;  ///< lines, hidden by meshes

  /// Adds a mesh.
  void add(SceneMesh mesh) { meshes.push_back(std::move(mesh)); }
  /// Adds lines.
  void add(SceneLines item) { lines.push_back(std::move(item)); }
  /// Adds the content of another scene.
  void add(const Scene& other);
};

/// Orthographic view of a scene, for one picture size.
struct View {
  Eigen::Vector3d right, up, towards;  ///< orthonormal; `towards` points at the viewer
  Eigen::Vector3d centre;              ///< point in the middle of the picture
  double pixels_per_unit = 1;          ///< scale: pixels per model unit
  int width = 0, height = 0;           ///< pixels

  /// Returns the position of a point in the picture, pixels, y down.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;
};

/// Viewpoint relative to a direction r that points up in the picture.
struct ViewOptions {
  /// Rotation about r from the frame's -v axis towards +u.
  double azimuth_degrees = 35;
  /// Elevation above the plane orthogonal to r; 0 is a side view.
  double elevation_degrees = 25;
  double margin = 0.04;           ///< free border, fraction of the smaller side
  int width = 800, height = 600;  ///< pixels
  /// Scale in place of the largest one that fits. The content then stands on the lower border, so that
  /// pictures side by side have one ground.
  std::optional<double> pixels_per_unit = {};
};

/// Returns the view that shows the whole scene as large as possible. Deterministic. Throws UsageError when
/// the scene is empty.
View fit_view(const Scene& scene, const Direction& up, const ViewOptions& options = {});

/// Returns the range of axis . p over all points of a scene; low > high for an empty scene.
Range scene_extent(const Scene& scene, const Eigen::Vector3d& axis);

/// Returns a view that depends only on direction and options, not on the content: rotation without framing,
/// for pictures in one scale side by side.
View turned_view(const Direction& up, const ViewOptions& options = {});

/// Side of a copy that shows a contact region.
enum class EnvelopeSide { upper, lower };

/// Returns contact regions as red marks, moved by `shift` (model units) away from the surface. Pieces smaller
/// than the shift are dots, pieces without area are lines.
Scene contact_marks(const std::vector<ContactRegion>& regions, EnvelopeSide side,
                    const Eigen::Vector3d& shift);

/// Renders a scene at `factor` times the size of the view, for smooth edges after reduction. Soft light with
/// ambient occlusion on white ground. Needs no display. Throws RenderError when there is no OpenGL context.
Image render(const Scene& scene, const View& view, int factor = 2);

}  // namespace stackabilization
