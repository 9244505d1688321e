#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::apps {

/// A design in the 3-D view of a page.
struct ViewedDesign {
  std::string title;
  const Points& vertices;
  const Stackability& measured;
  Eigen::Vector3d direction;  ///< along which it is stacked
};

/// The 3-D view of a page: all that a browser needs for it, without a network.
struct PageView {
  std::string head;     ///< scripts for the head of the page
  std::string element;  ///< where the view goes in its body
};

/// Returns the view of designs with the triangles of one shape, the first of them as given, beside each other
/// and seen by one camera; two empty texts where there is but one, or where the meshes are larger than a page
/// should be. The same modules as in the editor draw it. They and the meshes are compressed; a browser
/// without WebGL 2 or DecompressionStream leaves the view out.
PageView page_view(const Shape& rest, const std::vector<ViewedDesign>& designs);

/// Returns a JavaScript module without comments and indentation: lines that begin with `//`, and comments
/// `/* */` that begin a line and end one, but for those with `@license`.
std::string without_comments(std::string_view module);

}  // namespace stackabilization::apps
