#include "apps/common/json.h"

#include <utility>

#include "apps/common/design_json.h"

namespace stackabilization::apps {

Json to_json(const Eigen::Vector3d& vector) {
  return {vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0};
}

Json to_json(const Eigen::Matrix3d& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(to_json(Eigen::Vector3d(matrix.row(i).transpose())));
  return rows;
}

Json to_json(const Rational& value) {
  return {{"numerator", value.numerator()}, {"denominator", value.denominator()}};
}

Json to_json(Unit unit) {
  return unit == Unit::unknown ? Json(nullptr) : Json(unit_symbol(unit));
}

Json to_json(const Witness& witness) {
  return {{"triangles", {witness.upper_triangle, witness.lower_triangle}},
          {"point", to_json(witness.upper_point)},
          {"lower_point", to_json(witness.lower_point)}};
}

Json to_json(const SeparationGradients& gradients) {
  Json touches = Json::array();
  for (const SeparationTouch& touch : gradients.touches)
    touches.push_back({{"triangles", {touch.upper_triangle, touch.lower_triangle}},
                       {"weights", {to_json(touch.upper_weights), to_json(touch.lower_weights)}},
                       {"normal", to_json(touch.normal)},
                       {"direction", to_json(touch.direction)}});
  return {{"touches", std::move(touches)},
          {"complete", gradients.complete},
          {"one_plane_each", gradients.one_plane_each}};
}

Json to_json(const Findings& findings) {
  const std::optional<std::string> up =
      findings.likely_up ? std::optional(std::string(1, "xyz"[static_cast<int>(*findings.likely_up)]))
                         : std::nullopt;
  return {{"brief", brief(findings)},
          {"vertices", findings.vertices},
          {"triangles", findings.triangles},
          {"parts", findings.parts},
          {"components", findings.components},
          {"distinct_points", findings.distinct_points},
          {"unreferenced_vertices", findings.unreferenced_vertices},
          {"degenerate_faces", findings.degenerate_faces},
          {"duplicate_faces", findings.duplicate_faces},
          {"boundary_edges", findings.boundary_edges},
          {"non_manifold_edges", findings.non_manifold_edges},
          {"inconsistent_edges", findings.inconsistent_edges},
          {"self_intersections", to_json(findings.self_intersections)},
          {"closed", findings.closed},
          {"volume", to_json(findings.volume)},
          {"oriented_outward", findings.oriented_outward},
          {"lower", to_json(findings.lower)},
          {"upper", to_json(findings.upper)},
          {"likely_unit", to_json(findings.likely_unit.value_or(Unit::unknown))},
          {"likely_up", to_json(up)},
          {"up_reason", findings.up_reason}};
}

Json to_json(const std::vector<ContactRegion>& regions, const std::vector<std::string>& part_names) {
  Json list = Json::array();
  for (const ContactRegion& region : regions)
    list.push_back({{"type", name_of(region.type)},
                    {"parts", {part_names.at(region.upper_part), part_names.at(region.lower_part)}},
                    {"area", region.area},
                    {"centre", to_json(region.upper_centre)},
                    {"lower_centre", to_json(region.lower_centre)},
                    {"long_axis", to_json(region.long_axis)},
                    {"polygons", region.polygons.size()}});
  return list;
}

std::string json_text(const Json& document) {
  return document.dump(2) + "\n";
}

}  // namespace stackabilization::apps
