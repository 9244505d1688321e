#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/improvement/requirements.h"

/// Designs made by hand, for tests of what looks at designs.
namespace stackabilization::designs {

/// A rest and nothing else: designs are made by hand.
class Still : public DeformationModel {
 public:
  explicit Still(StructuredShape rest, DeformationKind kind = DeformationKind::controllers)
      : rest_(std::move(rest)), kind_(kind) {}

  const StructuredShape& rest() const override { return rest_; }
  DeformationKind kind() const override { return kind_; }
  std::vector<Handle> handles() const override { return {}; }
  Eigen::Vector3d centre(const Handle&) const override { return Eigen::Vector3d::Zero(); }
  DeformationResult edited(const Design& now, const Edit&, const DeformationConstraints&) const override {
    return {std::nullopt, now};
  }

 private:
  StructuredShape rest_;
  DeformationKind kind_;
};

/// A shape of one part.
StructuredShape alone(Shape shape, const Primitive& primitive);

/// Walls of slope 1/8 inside and outside, 0.5 thick sideways: f_max is half of the height of 8, and copies
/// touch with their whole walls.
StructuredShape cup();

/// Two cubes side by side along x, mirror images, in one mesh without common vertices.
StructuredShape two_cubes();

/// Frame boxes, and a target that everything reaches.
Requirements frame_requirements(double target = -1);

/// The vertices scaled along the axes.
Design scaled(Design design, const Eigen::Vector3d& factors);

}  // namespace stackabilization::designs
