#include <algorithm>
#include <cmath>

#include "apps/common/design_json.h"
#include "apps/common/measurement.h"
#include "apps/common/rendering.h"
#include "apps/common/text.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::apps {

namespace {

/// Contact regions that a report names; the JSON has all.
constexpr std::size_t listed_regions = 8;
/// An error of at least this much of that at half the resolution does not shrink.
constexpr double shrinks_below = 0.9;
/// Errors below this fraction of the height are not worth a warning.
constexpr double negligible_error = 1e-4;

Json sampling_json(const Sampling& sampling) {
  return {{"resolution", sampling.resolution},
          {"columns", sampling.columns},
          {"rows", sampling.rows},
          {"pixel_size", sampling.pixel_size},
          {"exact_f_max", sampling.exact_f_max},
          {"error", sampling.error},
          {"half_resolution_error", to_json(sampling.half_resolution_error)}};
}

Json exact_f_max_json(const Separation& separation) {
  return to_json(separation.blocked ? separation.value : Rational());
}

/// f_max / h, where there is a height.
std::optional<double> share_of_height(const Stackability& values) {
  return values.extent > 0 ? std::optional(values.f_max / values.extent) : std::nullopt;
}

void add_box_lines(TextTable& table, const Measurement& measurement, Unit unit) {
  const Stackability& values = measurement.values;
  table.add("Boxes", quantity(values.box_volume, unit, 3),
            "of one copy, and " + quantity(values.stack_box_volume(), unit, 3) +
                " with a side along the direction (" + name_of(measurement.options.boxes) + ")");
  if (values.box_volume > 0)
    table.add("Stackability", stackability_text(values.value) + " " + direction_text(values.direction),
              "space saved in a tall stack: 1 is all of it, 0 none");
  else
    table.add("Stackability", "not defined", "the shape is flat: its box has no volume");
}

/// Why a sampled value lies above the exact one; empty when it does not.
std::string excess_note(const Measurement& measurement) {
  const bool depth_buffer = measurement.method == Method::gl_raster;
  const double precision = depth_buffer ? depth_buffer_precision : tolerance::relative;
  if (measurement.sampling->error <= precision * measurement.values.extent) return {};
  return std::string("above the exact value: ") +
         (depth_buffer ? depth_buffer_excess
                       : "a sample lies on a wall along the direction, which only closed semantics count");
}

void add_sampling_lines(TextTable& table, const Measurement& measurement, Unit unit) {
  const Sampling& sampling = *measurement.sampling;
  const double height = measurement.values.extent;
  table.add("Samples", std::to_string(sampling.columns) + " x " + std::to_string(sampling.rows),
            "pixels of " + quantity(sampling.pixel_size, unit));
  table.add("Error", quantity(sampling.error, unit),
            "against the exact f_max of " + quantity(sampling.exact_f_max, unit) +
                (height > 0 ? "; " + percent(sampling.error / height) + " of the height" : ""));
  if (const std::string note = excess_note(measurement); !note.empty()) table.add("", "", note);
  if (!sampling.half_resolution_error) return;
  const bool stuck = sampling.error < -negligible_error * height &&
                     -sampling.error >= shrinks_below * std::abs(*sampling.half_resolution_error);
  table.add("", quantity(*sampling.half_resolution_error, unit),
            stuck ? "at half the resolution: it does NOT shrink, thin parts slip between the samples"
                  : "at half the resolution");
}

/// What the contacts leave out, for people.
void add_omission_lines(TextTable& table, const Contacts& contacts) {
  if (contacts.complete) return;
  table.add("", "not all",
            "too many pairs of triangles touch: each is listed with its deepest partner alone");
  if (const std::size_t parts = contacts.coincident_parts.size(); parts > 0)
    table.add("", counted(static_cast<long long>(parts), "part"),
              parts == 1 ? "touches too, where another named above lies in the same place"
                         : "touch too, where others named above lie in the same place");
}

/// The same for programs; nothing where nothing is left out.
void add_omissions(Json& document, const Contacts& contacts, const std::vector<std::string>& part_names) {
  if (contacts.complete) return;
  Json coincident = Json::array();
  for (const std::int32_t part : contacts.coincident_parts) coincident.push_back(part_names.at(part));
  document["contacts_omitted"] = {{"reason", "too many pairs of triangles touch"},
                                  {"listed", "the deepest partner of each triangle"},
                                  {"coincident_parts", std::move(coincident)}};
}

Json layer_json(const LayerFit& layer) {
  return {{"distance", layer.layer},
          {"close_share", layer.fit.share()},
          {"close_area", layer.fit.close_area},
          {"projected_area", layer.fit.projected_area},
          {"complete", layer.fit.complete},
          {"largest_sampled_gap", layer.largest_gap},
          {"resolution", layer.resolution}};
}

void add_layer_lines(TextTable& table, const LayerFit& layer, Unit unit) {
  table.add("Close fit", (layer.fit.complete ? "" : "at least ") + percent(layer.fit.share()),
            "of the area seen along the direction lies within " + quantity(layer.layer, unit) +
                " of the copy below when they touch");
  table.add("", quantity(layer.largest_gap, unit),
            "largest distance between the two, of " + std::to_string(layer.resolution) +
                " samples along the longer side");
}

void add_contact_lines(TextTable& table, const Measurement& measurement, const Model& model) {
  const std::vector<ContactRegion>& regions = measurement.contacts.regions;
  table.add("Contacts", counted(static_cast<long long>(regions.size()), "region"),
            "where a copy rests on the one below");
  for (std::size_t i = 0; i < std::min(regions.size(), listed_regions); ++i)
    table.add(
        "", std::string(name_of(regions[i].type)) + ", " + quantity(regions[i].area, model.shape.unit, 2),
        model.shape.part_names[regions[i].lower_part] + " on " +
            model.shape.part_names[regions[i].upper_part] + " at " + point_text(regions[i].upper_centre));
  if (regions.size() > listed_regions) table.add("", "...", "all of them with --json");
  add_omission_lines(table, measurement.contacts);
}

}  // namespace

std::string name_of(Method method) {
  switch (method) {
    case Method::exact:
      return "exact";
    case Method::rays:
      return "rays";
    case Method::raster:
      return "raster";
    case Method::gl_raster:
      return "gl-raster";
  }
  return "";
}

std::string name_of(ContactSemantics semantics) {
  return semantics == ContactSemantics::solid ? "solid" : "closed";
}

std::string name_of(BoxModel boxes) {
  return boxes == BoxModel::oriented ? "oriented" : "frame";
}

void add_measurement(Json& document, const Measurement& measurement, const Model& model) {
  const Stackability& values = measurement.values;
  document["direction"] = to_json(values.direction);
  document["method"] = name_of(measurement.method);
  document["semantics"] = name_of(measurement.options.semantics);
  document["boxes"] = name_of(measurement.options.boxes);
  document["f_max"] = values.f_max;
  document["height"] = values.extent;
  document["f_max_over_height"] = to_json(share_of_height(values));
  document["stackability"] = values.box_volume > 0 ? Json(values.value) : Json(nullptr);
  document["nesting_increment"] = values.f_max;
  document["box_volume"] = values.box_volume;
  document["stack_box_volume"] = values.stack_box_volume();
  const std::optional<Separation>& separation = measurement.separation;
  document["exact"] = separation ? exact_f_max_json(*separation) : Json(nullptr);
  document["witness"] = separation && separation->blocked ? to_json(separation->witness) : Json(nullptr);
  document["gradient"] = measurement.gradients ? to_json(*measurement.gradients) : Json(nullptr);
  const std::vector<std::string>& names = model.shape.part_names;
  document["contacts"] = separation ? to_json(measurement.contacts.regions, names) : Json(nullptr);
  add_omissions(document, measurement.contacts, names);
  if (measurement.layer) document["layer"] = layer_json(*measurement.layer);
  if (measurement.sampling) document["sampling"] = sampling_json(*measurement.sampling);
}

std::string measurement_text(const Measurement& measurement, const Model& model) {
  const Stackability& values = measurement.values;
  const Unit unit = model.shape.unit;
  const std::optional<double> share = share_of_height(values);
  TextTable table;
  add_model_line(table, model);
  table.add("Direction", vector_text(values.direction), "copies are lifted along it");
  table.add("Height", quantity(values.extent, unit), "of one copy along the direction");
  table.add("f_max", quantity(values.f_max, unit),
            "smallest lift that sets a copy free" +
                (share ? ", " + percent(*share) + " of the height (" : " (") + name_of(measurement.method) +
                ", " + name_of(measurement.options.semantics) + ")");
  add_box_lines(table, measurement, unit);
  if (measurement.sampling) add_sampling_lines(table, measurement, unit);
  if (measurement.separation) add_contact_lines(table, measurement, model);
  if (measurement.layer) add_layer_lines(table, *measurement.layer, unit);
  return table.text() + "Each further copy adds " + quantity(values.f_max, unit) +
         (unit == Unit::unknown ? " (model units)" : "") + " to the stack" +
         (share ? ": " + percent(*share) + " of the height.\n" : ".\n");
}

}  // namespace stackabilization::apps
