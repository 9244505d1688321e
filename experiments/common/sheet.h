#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::experiments {

struct SheetTile {
  Shape shape;
  std::vector<std::string> captions;  ///< lines below it
  bool at_rest = false;               ///< whether those that follow come from this design
};

/// Designs side by side as an experiment states them, the first one at rest; it becomes a picture where
/// pictures are built.
struct Sheet {
  std::string title;
  Direction direction;  ///< up
  std::vector<SheetTile> tiles;
};

}  // namespace stackabilization::experiments
