#include "support/cups.h"

#include <cmath>
#include <variant>

#include "support/solids.h"
#include "support/still_designs.h"

namespace stackabilization::cups {

namespace {

Primitive primitive(double bottom, double top) {
  GeneralizedCylinder cylinder;
  cylinder.centres = (Points(2, 3) << 0, 0, 0, 0, 0, Cups::height).finished();
  cylinder.radii = Eigen::Vector2d(bottom, top);
  return cylinder;
}

Shape shape(double bottom, double top, int segments) {
  const double floor = 0.2, at_floor = bottom + (top - bottom) * floor / Cups::height;
  const double inside = 1 - Cups::wall;
  return solids::frustum_shell({bottom, top, inside * at_floor, inside * top, Cups::height, floor, segments});
}

}  // namespace

Cups::Cups(int segments, double foot) : segments_(segments) {
  rest_.shape = shape(foot, 1, segments);
  rest_.structure.parts = {{"part", primitive(foot, 1), {}}};
  rest_.structure.diagonal = std::sqrt(8 + height * height);
}

std::vector<Handle> Cups::handles() const {
  return {{HandleKind::section, 0, 0}, {HandleKind::section, 0, 1}};
}

Eigen::Vector3d Cups::centre(const Handle& handle) const {
  return {0, 0, handle.index * height};
}

DeformationResult Cups::edited(const Design& now, const Edit& edit,
                               const DeformationConstraints& constraints) const {
  const auto* scaling = std::get_if<Scale>(&edit.operation);
  if (!constraints.fixed_parts.empty()) return {Refusal{.cause = RefusalCause::fixed_part, .part = 0}, now};
  if (scaling == nullptr || edit.handle.kind != HandleKind::section)
    return {Refusal{.cause = RefusalCause::symmetry, .part = 0, .amount = 0.25}, now};
  Eigen::Vector2d sizes = radii(now);
  sizes[edit.handle.index] *= scaling->factor;
  Design design{now.edits, {primitive(sizes[0], sizes[1])}, shape(sizes[0], sizes[1], segments_)};
  design.edits.push_back(edit);
  return {std::nullopt, design};
}

RequirementChecker checker(double target) {
  return {space, designs::frame_requirements(target)};
}

Eigen::Vector2d radii(const Design& design) {
  return std::get<GeneralizedCylinder>(design.primitives.front()).radii;
}

Edit scale(int section, double factor) {
  return {{HandleKind::section, 0, section}, Scale{factor, {}}, Falloff::linear};
}

}  // namespace stackabilization::cups
