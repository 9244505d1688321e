#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <Eigen/Geometry>

#include "stackabilization/deformation/as_rigid_as_possible.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using CgalDeformation =
    CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, CGAL::ORIGINAL_ARAP>;

/// What CGAL makes of it: rows as in `shape`, of which those with `held` go to `targets`.
Points by_cgal(const Shape& shape, const std::vector<bool>& held, const Points& targets,
               unsigned iterations) {
  Mesh mesh;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    mesh.add_vertex(Point(shape.vertices(v, 0), shape.vertices(v, 1), shape.vertices(v, 2)));
  const auto vertex = [](auto row) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(row)); };
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    mesh.add_face(vertex(shape.triangles(t, 0)), vertex(shape.triangles(t, 1)),
                  vertex(shape.triangles(t, 2)));
  CgalDeformation deformation(mesh);
  deformation.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (std::size_t v = 0; v < held.size(); ++v)
    if (held[v]) deformation.insert_control_vertex(vertex(v));
  REQUIRE(deformation.preprocess());
  for (std::size_t v = 0; v < held.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    if (held[v])
      deformation.set_target_position(vertex(v), Point(targets(row, 0), targets(row, 1), targets(row, 2)));
  }
  deformation.deform(iterations, 0);
  Points out(shape.vertex_count(), 3);
  for (const auto v : mesh.vertices())
    out.row(static_cast<Eigen::Index>(v)) << mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z();
  return out;
}

}  // namespace

TEST_CASE("as rigid as possible: the same points as CGAL's, iteration by iteration") {
  // No pair of angles of a subdivided icosahedron is obtuse: no weight is clamped.
  Shape shape = solids::sphere(1, 2);
  shape.vertices.col(2) *= 1.2;
  std::vector<bool> held(static_cast<std::size_t>(shape.vertex_count()));
  Points targets = shape.vertices;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 1, 3).normalized()).toRotationMatrix();
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    const double z = shape.vertices(v, 2);
    held[static_cast<std::size_t>(v)] = z < -0.8 || z > 0.9;
    if (z > 0.9)
      targets.row(v) = (targets.row(v) * turn.transpose()).eval() + Eigen::RowVector3d(0.5, 0, 0.3);
  }
  const RigidSurface surface(shape.vertices, shape.triangles);
  const std::vector<Eigen::Matrix3d> identities(held.size(), Eigen::Matrix3d::Identity());
  for (const int iterations : {1, 2, 5, 50}) {
    const RotatedPoints now = surface.deformed(held, {targets, identities}, {iterations, 0});
    CHECK((now.points - by_cgal(shape, held, targets, static_cast<unsigned>(iterations)))
              .cwiseAbs()
              .maxCoeff() < 1e-8);
    CHECK((now.points - shape.vertices).cwiseAbs().maxCoeff() > 0.1);
  }
}

TEST_CASE("as rigid as possible: rotations are told, smoothness makes them alike") {
  const Shape shape = solids::sphere(1, 2);
  std::vector<bool> held(static_cast<std::size_t>(shape.vertex_count()));
  Points targets = shape.vertices;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    held[static_cast<std::size_t>(v)] = std::abs(shape.vertices(v, 2)) > 0.8;
    if (shape.vertices(v, 2) > 0.8) targets.row(v) << -targets(v, 0), -targets(v, 1), targets(v, 2) + 0.5;
  }
  const RigidSurface surface(shape.vertices, shape.triangles);
  const std::vector<Eigen::Matrix3d> identities(held.size(), Eigen::Matrix3d::Identity());
  const auto roughness = [&](double smoothness) {
    const RotatedPoints now = surface.deformed(held, {targets, identities}, {40, smoothness});
    double sum = 0;
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Matrix3d& a = now.rotations[static_cast<std::size_t>(shape.triangles(t, k))];
        const Eigen::Matrix3d& b = now.rotations[static_cast<std::size_t>(shape.triangles(t, (k + 1) % 3))];
        CHECK((a * a.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
        CHECK(a.determinant() > 0);
        sum += (a - b).squaredNorm();
      }
    return sum;
  };
  CHECK(roughness(0.02) < 0.9 * roughness(0));
}

TEST_CASE("as rigid as possible: rigid motions of what is held are followed to rounding") {
  Shape shape = solids::torus({});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(2, 1, 3).normalized()).toRotationMatrix();
  const Points expected = (shape.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3);
  std::vector<bool> held(static_cast<std::size_t>(shape.vertex_count()));
  for (std::size_t v = 0; v < 40; ++v) held[v] = true;
  const std::vector<Eigen::Matrix3d> turns(held.size(), turn);
  const RotatedPoints now =
      RigidSurface(shape.vertices, shape.triangles).deformed(held, {expected, turns}, {20, 0});
  CHECK((now.points - expected).cwiseAbs().maxCoeff() < 1e-11);
}
