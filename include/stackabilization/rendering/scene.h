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

/// How the surface of a mesh is shown.
enum class Finish {
  shaded,  ///< lit, with creases and borders drawn as thin lines
  smooth,  ///< lit, no lines
  plain,   ///< one flat colour, no lines: marks such as contact regions
};

/// A shape in a scene, in its own model coordinates.
struct SceneMesh {
  Shape shape;                     ///< model units
  std::vector<Colour> colours;     ///< one for all, or one per part
  double opacity = 1;              ///< in (0, 1]
  Finish finish = Finish::shaded;  ///< lit or flat, with or without lines
};

/// Polylines of one colour and width. A polyline of one point is a dot.
struct SceneLines {
  std::vector<Points> polylines;  ///< each k x 3, model units
  Colour colour = palette::ink;   ///< of all of them
  double width = 1.5;             ///< pixels of the final picture
};

/// What a 3D picture shows. Light, ground and framing are fixed; content and colours are the caller's.
struct Scene {
  std::vector<SceneMesh> meshes;  ///< hidden by each other as in space
  std::vector<SceneLines> lines;  ///< hidden by meshes

  /// A further mesh.
  void add(SceneMesh mesh) { meshes.push_back(std::move(mesh)); }
  /// Further lines.
  void add(SceneLines item) { lines.push_back(std::move(item)); }
  /// All of another scene.
  void add(const Scene& other);
};

/// Orthographic view of a scene, for one picture size.
struct View {
  Eigen::Vector3d right, up, towards;  ///< orthonormal; `towards` points at the viewer
  Eigen::Vector3d centre;              ///< shown in the middle of the picture
  double pixels_per_unit = 1;          ///< scale: pixels per model unit
  int width = 0, height = 0;           ///< pixels

  /// Where a point appears, pixels, y down.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;
};

/// Where the viewer stands, about a direction r that points up in the picture.
struct ViewOptions {
  double azimuth_degrees = 35;    ///< turned about r from the frame's -v axis towards +u
  double elevation_degrees = 25;  ///< above the plane orthogonal to r; 0 is a side view
  double margin = 0.04;           ///< free border, fraction of the smaller side
  int width = 800, height = 600;  ///< pixels
  /// Scale to be used instead of the largest that fits; the content then stands on the lower border, so that
  /// pictures side by side have one ground.
  std::optional<double> pixels_per_unit = {};
};

/// The view that shows the whole scene as large as fits. Deterministic. Throws UsageError when the scene is
/// empty.
View fit_view(const Scene& scene, const Direction& up, const ViewOptions& options = {});

/// Range of axis . p over all points of a scene; low > high when there is none.
Range scene_extent(const Scene& scene, const Eigen::Vector3d& axis);

/// The same eye for any content: rotation only, so that pictures side by side can share one scale.
View turned_view(const Direction& up, const ViewOptions& options = {});

/// Which side of a copy a contact region is shown on.
enum class EnvelopeSide { upper, lower };

/// Contact regions as red marks, moved by `shift` (model units) so that they do not sink into the surface.
/// Pieces smaller than the shift show as dots, pieces without area as lines.
Scene contact_marks(const std::vector<ContactRegion>& regions, EnvelopeSide side,
                    const Eigen::Vector3d& shift);

/// Pixels of a scene, twice the size of the view (`factor` 2) for smooth edges when it is scaled down. Soft
/// light with ambient occlusion on white ground; needs no display. Throws RenderError when there is no OpenGL
/// context.
Image render(const Scene& scene, const View& view, int factor = 2);

}  // namespace stackabilization
