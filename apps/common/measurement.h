#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/model.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::apps {

/// Where f_max comes from.
enum class Method { exact, rays, raster, gl_raster };

/// What sampling did to f_max.
struct Sampling {
  int resolution = 0;     ///< samples along the longer side
  double pixel_size = 0;  ///< model units
  int columns = 0, rows = 0;
  double exact_f_max = 0;                       ///< model units
  double error = 0;                             ///< sampled minus exact, model units
  std::optional<double> half_resolution_error;  ///< the same at half the resolution
};

/// How much of a copy lies within a layer of the one below when they touch.
struct LayerFit {
  double layer = 0;   ///< distance along the direction, model units
  Contacts contacts;  ///< where it does
  CloseFit fit;
  double largest_gap = 0;  ///< between the two, at samples, model units
  int resolution = 0;      ///< samples along the longer side
};

/// One direction measured: what `measure` and `search` report.
struct Measurement {
  Method method = Method::exact;
  StackabilityOptions options;
  Stackability values;
  std::optional<Separation> separation;  ///< exact method only
  /// Of f_max; exact method only, where copies can collide.
  std::optional<SeparationGradients> gradients;
  Contacts contacts;                 ///< exact method only
  std::optional<LayerFit> layer;     ///< exact method only, where asked for
  std::optional<Sampling> sampling;  ///< sampled methods only
};

/// Exact f_max with its witness and contact regions, and S.
Measurement measure_exactly(const StackabilitySolver& solver, const Direction& direction);

/// What of a copy lies within `layer` (model units) of the one below, and how far apart they are at samples,
/// `resolution` along the longer side. Precondition: `measured` comes from `measure_exactly`.
LayerFit measure_layer(const StackabilitySolver& solver, const Measurement& measured, double layer,
                       int resolution);

/// f_max from a height field of `resolution` samples along its longer side, set beside the exact one.
Measurement measure_by_sampling(const StackabilitySolver& solver, const Direction& direction, Method method,
                                int resolution);

/// Spellings on the command line.
std::string name_of(Method method);
std::string name_of(ContactSemantics semantics);
std::string name_of(BoxModel boxes);

void add_measurement(Json& document, const Measurement& measurement, const Model& model);
std::string measurement_text(const Measurement& measurement, const Model& model);

}  // namespace stackabilization::apps
