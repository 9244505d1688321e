#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <memory>

#include "common/clock.h"
#include "speed/competitor.h"

namespace stackabilization::experiments {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> build(const Shape& shape) {
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(shape.triangle_count()), static_cast<int>(shape.vertex_count()));
  std::vector<fcl::Vector3d> vertices;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    vertices.emplace_back(shape.vertices.row(v).transpose());
  std::vector<fcl::Triangle> triangles;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    triangles.emplace_back(static_cast<std::size_t>(shape.triangles(t, 0)),
                           static_cast<std::size_t>(shape.triangles(t, 1)),
                           static_cast<std::size_t>(shape.triangles(t, 2)));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

double extent(const Shape& shape, const Eigen::Vector3d& unit) {
  const Eigen::VectorXd heights = shape.vertices * unit;
  return heights.maxCoeff() - heights.minCoeff();
}

}  // namespace

Competitor fcl_bisection(const Shape& shape) {
  Competitor result;
  result.name = "FCL bisection";
  result.semantics = ContactSemantics::closed;
  const double start = processor_now();
  const std::shared_ptr<Model> model = build(shape);
  result.build_seconds = processor_now() - start;
  result.measure = [model, &shape](const Direction& direction) {
    const Eigen::Vector3d unit = direction.unit();
    const double height = extent(shape, unit);
    const auto collides = [&](double lift) {
      fcl::Transform3d lifted = fcl::Transform3d::Identity();
      lifted.translation() = lift * unit;
      fcl::CollisionRequestd request(1, false);
      fcl::CollisionResultd collision;
      return fcl::collide(model.get(), fcl::Transform3d::Identity(), model.get(), lifted, request,
                          collision) > 0;
    };
    constexpr int steps = 64;
    double free = height, blocked = 0;
    for (int step = steps; step > 0; --step) {
      const double lift = height * step / steps;
      if (collides(lift)) {
        blocked = lift;
        break;
      }
      free = lift;
    }
    while (free - blocked > 1e-6 * height) {
      const double middle = (free + blocked) / 2;
      (collides(middle) ? blocked : free) = middle;
    }
    return free;
  };
  return result;
}

}  // namespace stackabilization::experiments
