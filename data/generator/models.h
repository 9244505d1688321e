#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::models {

Shape mug_with_handle();
Shape cup();
Shape bowl();
Shape pot_with_handle();
Shape bottle();

Shape bucket_with_handles();
Shape basket();
Shape hat();
Shape crate();

Shape table();
Shape stool();
Shape chair();
Shape armchair();
Shape swivel_chair();
Shape zigzag_chair();

struct Model {
  std::string name;  ///< Of the file, without extension.
  Shape shape;
};
/// All of them, in alphabetical order.
std::vector<Model> all_models();

}  // namespace stackabilization::models
