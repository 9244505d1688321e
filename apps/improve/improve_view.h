#pragma once

#include <string>
#include <string_view>

#include "apps/improve/improve_report.h"

namespace stackabilization::apps {

/// The 3-D view of a page: all that a browser needs for it, without a network.
struct PageView {
  std::string head;     ///< scripts for the head of the page
  std::string element;  ///< where the view goes in its body
};

/// Returns the view of the shape at rest beside the solutions, or beside what came nearest, all seen by one
/// camera; two empty texts where there is no design, or where the meshes are larger than a page should be.
/// The same modules as in the editor draw it. They and the meshes are compressed; a browser without WebGL 2
/// or DecompressionStream leaves the view out.
PageView page_view(const ImproveReport& report);

/// Returns a JavaScript module without comments and indentation: lines that begin with `//`, and comments
/// `/* */` that begin a line and end one, but for those with `@license`.
std::string without_comments(std::string_view module);

}  // namespace stackabilization::apps
