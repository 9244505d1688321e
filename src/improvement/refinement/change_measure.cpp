#include "stackabilization/improvement/change_measure.h"

namespace stackabilization {

double size_of(ChangeMeasure measure, const Distortion& distortion, const ShapeChange& shape) {
  double size = 0;
  if (measure != ChangeMeasure::displacement) size += distortion.total();
  if (measure != ChangeMeasure::distortion) size += shape.root_mean_square;
  return size;
}

double size_of(ChangeMeasure measure, const Candidate& candidate, const Shape& rest) {
  ShapeChange shape;
  if (measure != ChangeMeasure::distortion) shape = shape_change(rest, candidate.design.shape);
  return size_of(measure, candidate.energy.distortion, shape);
}

}  // namespace stackabilization
