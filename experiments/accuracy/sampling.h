#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization::experiments {

/// One way to sample envelopes, prepared for one shape.
struct Sampler {
  std::string method;  ///< "CPU raster", "OpenGL raster", "rays"
  std::function<HeightField(const Direction&, const Window&)> sample;
  int max_for_all = 0;  ///< samples a side up to which it is quick enough for every direction
  int largest = 0;      ///< samples a side up to which it is run at all
};

/// Every way there is; the OpenGL raster only when pictures are built. `shape` must outlive them.
std::vector<Sampler> samplers(const Shape& shape);

/// Name of the authors' own set-up: an OpenGL raster with their framing.
inline constexpr const char* authors_method = "authors' framing";

/// A sampling that was made, and what it saw.
struct Sampling {
  std::string method;
  int samples = 0;    ///< a side of the window
  double across = 0;  ///< samples across the longer side of the projection
  Window window;
  double f_max = 0;              ///< model units
  double processor_seconds = 0;  ///< of all threads
};

/// Samples along one direction: every method at 32, 64 ... samples a side, as far as it is quick enough - for
/// one of many directions, or for one of few - and in the end the authors' set-up.
std::vector<Sampling> sample_all(const Shape& shape, const std::vector<Sampler>& samplers,
                                 const Direction& direction, bool one_of_few);

}  // namespace stackabilization::experiments
