#include "support/random_edits.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/variants.h"

namespace stackabilization::random_edits {

namespace {

/// Edits of a few per cent: moves up to 5 % of the diagonal in any direction or along an axis, turns up to
/// 0.1, factors up to 1.1 and down to 1 / 1.1.
class RandomEdits {
 public:
  RandomEdits(const ControllerModel& model, std::uint64_t seed)
      : by_kind_(model.rest().structure.parts.size()),
        diagonal_(model.rest().structure.diagonal),
        random_(seed) {
    for (const Handle& handle : model.handles()) {
      auto& of_part = by_kind_[static_cast<std::size_t>(handle.part)];
      if (of_part.empty() || of_part.back().front().kind != handle.kind) of_part.emplace_back();
      of_part.back().push_back(handle);
    }
  }

  Edit next() {
    Edit edit;
    const auto any = [&](const auto& list) -> const auto& {
      return list[random_.below(list.size())];
    };
    edit.handle = any(any(any(by_kind_)));
    const bool whole = edit.handle.kind == HandleKind::part, face = edit.handle.kind == HandleKind::face;
    const std::uint64_t choice = random_.below(3);
    if (choice == 1 && (whole || face))
      edit.operation = Rotate{direction(), random_.uniform(-0.1, 0.1)};
    else if (choice == 2 && edit.handle.kind != HandleKind::corner)
      edit.operation = Scale{std::pow(1.1, random_.uniform(-1, 1)),
                             whole && random_.below(2) == 0 ? std::optional(direction()) : std::nullopt};
    else
      edit.operation = Move{random_.uniform(0, 0.05) * diagonal_ * direction()};
    if (edit.handle.kind == HandleKind::section && random_.below(2) == 0) edit.falloff = Falloff::linear;
    return edit;
  }

  DeformationConstraints constraints() {
    DeformationConstraints constraints;
    if (random_.below(2) == 0) constraints.keep_extent = Direction(direction());
    if (random_.below(4) == 0) constraints.box_tolerance = 0.03;
    return constraints;
  }

 private:
  /// Every other one is an axis: those are what symmetric parts allow.
  Eigen::Vector3d direction() {
    if (random_.below(2) == 0) return random_.on_sphere();
    return (random_.below(2) == 0 ? 1 : -1) *
           Eigen::Vector3d::Unit(static_cast<Eigen::Index>(random_.below(3)));
  }

  std::vector<std::vector<std::vector<Handle>>> by_kind_;  ///< per part, per kind: all equally likely
  double diagonal_;
  solids::Random random_;
};

std::string kind_of(const Edit& edit, const DeformationConstraints& constraints) {
  const char* operations[] = {"move", "rotate", "scale"};
  const std::vector<std::string>& handles = handle_kind_names();
  return std::string(operations[edit.operation.index()]) + ' ' +
         handles[static_cast<std::size_t>(edit.handle.kind)] +
         (constraints.keep_extent || constraints.box_tolerance ? ", bounded" : "");
}

/// Volumes at the corners of a cuboid over those at rest.
double smallest_corner_ratio(const Cuboid& rest, const Cuboid& now) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 8; ++k) {
    const auto volume_at = [&](const Cuboid& c) {
      Eigen::Matrix3d edges;
      for (int a = 0; a < 3; ++a)
        edges.col(a) = (c.corners.row(k | 1 << a) - c.corners.row(k & ~(1 << a))).transpose();
      return edges.determinant();
    };
    least = std::min(least, volume_at(now) / volume_at(rest));
  }
  return least;
}

/// Everything that must hold of an accepted edit, checked from the result alone.
void check_accepted(const ControllerModel& model, const Design& design,
                    const DeformationConstraints& constraints) {
  const StructuredShape& rest = model.rest();
  for (const double residual : relation_residuals(rest.structure, design.primitives))
    REQUIRE(residual <= 1e-6);
  for (std::size_t part = 0; part < design.primitives.size(); ++part) {
    if (const auto* cuboid = std::get_if<Cuboid>(&design.primitives[part])) {
      if (volume(rest.structure.parts[part].primitive) > 1e-12 * std::pow(rest.structure.diagonal, 3))
        REQUIRE(smallest_corner_ratio(std::get<Cuboid>(rest.structure.parts[part].primitive), *cuboid) > 0);
    } else {
      REQUIRE(std::get<GeneralizedCylinder>(design.primitives[part]).radii.minCoeff() > 0);
    }
  }
  const Shape& shape = design.shape;
  REQUIRE(shape.vertices.allFinite());
  if (constraints.keep_extent) {
    const Eigen::Vector3d r = constraints.keep_extent->unit();
    const double before = range_along(rest.shape, r).length();
    REQUIRE(std::abs(range_along(shape, r).length() - before) <= 1e-9 * before);
  }
  if (constraints.box_tolerance)
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d r = Eigen::Vector3d::Unit(axis);
      const double before = range_along(rest.shape, r).length();
      REQUIRE(std::abs(range_along(shape, r).length() - before) <=
              (*constraints.box_tolerance + 1e-9) * before);
    }
}

}  // namespace

std::map<std::string, Tally> run(const ControllerModel& model, int count, std::uint64_t seed) {
  std::map<std::string, Tally> tallies;
  RandomEdits edits(model, seed);
  Design now = model.at_rest();
  for (int i = 0; i < count; ++i) {
    if (i % 5 == 0) now = model.at_rest();
    const Edit edit = edits.next();
    // A bounded edit of something that is out of bounds already says little.
    const DeformationConstraints constraints = i % 5 == 0 ? edits.constraints() : DeformationConstraints();
    const DeformationResult outcome = model.edited(now, edit, constraints);
    Tally& tally = tallies[kind_of(edit, constraints)];
    if (outcome.refusal) {
      REQUIRE_FALSE(describe(*outcome.refusal, model.rest().structure).empty());
      const RefusalCause cause = outcome.refusal->cause;
      const bool symmetry = cause == RefusalCause::symmetry || cause == RefusalCause::symmetry_of_shape ||
                            cause == RefusalCause::symmetry_of_turn;
      ++(symmetry ? tally.contradicted : tally.broken);
      continue;
    }
    ++tally.accepted;
    check_accepted(model, outcome.design, constraints);
    now = outcome.design;
  }
  return tallies;
}

void report(const std::string& name, const std::map<std::string, Tally>& tallies) {
  for (const auto& [kind, tally] : tallies)
    std::printf("%-24s %-24s accepted %4d, against a symmetry %4d, otherwise refused %4d\n", name.c_str(),
                kind.c_str(), tally.accepted, tally.contradicted, tally.broken);
}

double acceptance(const std::map<std::string, Tally>& tallies) {
  int accepted = 0, all = 0;
  for (const auto& [kind, tally] : tallies) accepted += tally.accepted, all += tally.accepted + tally.broken;
  return static_cast<double>(accepted) / all;
}

}  // namespace stackabilization::random_edits
