#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/curve_plot.h"
#include "stackabilization/rendering/drawing.h"
#include "stackabilization/rendering/legend.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/stacking/map.h"

// Views, plots and images side by side in one drawing.
namespace stackabilization {

/// An arrow in a scene, such as a direction or the effect of an edit.
struct SceneArrow {
  Eigen::Vector3d from, to;      ///< model units
  Colour colour = palette::ink;  ///< colour of shaft and head
  double width = 0.14;           ///< width of the shaft, em
};

/// A text at a point of a scene.
struct SceneLabel {
  Eigen::Vector3d at;            ///< model units
  std::string text;              ///< one line, UTF-8
  Colour colour = palette::ink;  ///< colour of the text
  Anchor anchor = Anchor::left;  ///< end of the text at the point
};

/// A circle that marks a place in a scene.
struct SceneRing {
  Eigen::Vector3d centre;            ///< model units
  double radius = 0;                 ///< model units
  Colour colour = palette::contact;  ///< colour of the line
};

/// A vertical dimension line beside a scene, from the height of one point to that of another.
struct SceneDimension {
  Eigen::Vector3d from, to;    ///< model units
  std::string caption;         ///< text beside the line, such as "h"
  Anchor side = Anchor::left;  ///< side of the scene: left or right
};

/// Elements over the picture of a scene. They are sharp and never occluded. In drawing order.
struct SceneOverlay {
  std::vector<SceneLines> lines;           ///< widths are pixels of the drawing
  std::vector<SceneRing> rings;            ///< over the lines
  std::vector<SceneArrow> arrows;          ///< over the rings
  std::vector<SceneLabel> labels;          ///< over the arrows
  std::vector<SceneDimension> dimensions;  ///< beside the scene
};

/// A scene from one viewpoint.
struct ScenePanel {
  Scene scene;                                          ///< model units
  Direction up{0, 0, 1};                                ///< in the picture
  double azimuth_degrees = 35, elevation_degrees = 25;  ///< see ViewOptions
  SceneOverlay over;                                    ///< drawn on top
};

/// One cell of a sheet: a scene, a plot, a gap function with its colour bar, or a map of S over all
/// directions.
struct Panel {
  std::variant<ScenePanel, CurvePlot, HeightField, StackabilityMap> content;  ///< content of the cell
  std::string title;                  ///< bold text below the content; may be empty
  std::vector<std::string> captions;  ///< lines below the title, broken when too long
  double share = 1;                   ///< share of the width of the row, relative to the other panels, > 0
};

/// Scale of the scenes of a row.
enum class PanelScale {
  own,     ///< every scene as large as fits
  common,  ///< one scale, in which the largest scene fits, and one ground for all scenes
};

/// Panels beside each other.
struct PanelRow {
  std::vector<Panel> panels;  ///< from left to right, at least one
  /// Height of the pictures, fraction of the width of the sheet, in (0, 10]. Rows of scenes only may be
  /// lower.
  double height = 0.5;
  PanelScale scale = PanelScale::own;  ///< scale of the scenes
};

/// Size, heading and legend of a `panel_sheet`.
struct PanelSheetOptions {
  int width = 820;                  ///< pixels; the height results from the rows
  double text_size = 20;            ///< pixels per em: about 6 points where the sheet is 8.5 cm wide
  std::string title;                ///< heading; may be empty
  std::vector<std::string> notes;   ///< lines under the heading
  std::vector<LegendEntry> legend;  ///< legend below all rows
};

/// Draws rows of panels from top to bottom. Throws UsageError when a row has no panel, a share or height is
/// out of range or a scene is empty, and as `plot_elements` and `map_picture` do. Throws RenderError when
/// there is no OpenGL context.
Drawing panel_sheet(const std::vector<PanelRow>& rows, const PanelSheetOptions& options = {});

}  // namespace stackabilization
