#include "support/variants.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace stackabilization::solids {

std::uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

double Random::uniform() {
  return std::ldexp(static_cast<double>(next() >> 11), -53);
}

std::uint64_t Random::below(std::uint64_t bound) {
  return next() % bound;
}

Eigen::Vector3d Random::in_cube() {
  const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
  return {x, y, z};
}

Eigen::Vector3d Random::on_sphere() {
  for (;;) {
    const Eigen::Vector3d p = in_cube();
    const double squared = p.squaredNorm();
    if (squared > 0.01 && squared <= 1) return p / std::sqrt(squared);
  }
}

Shape triangle_soup(const Soup& options) {
  Random random(options.seed);
  Shape shape;
  shape.vertices.resize(3 * options.count, 3);
  shape.triangles.resize(options.count, 3);
  for (int t = 0; t < options.count; ++t) {
    const Eigen::Vector3d centre = random.in_cube();
    for (int k = 0; k < 3; ++k) {
      shape.vertices.row(3 * t + k) = centre + options.size * random.in_cube();
      shape.triangles(t, k) = 3 * t + k;
    }
    shape.triangle_part.push_back(t % options.parts);
  }
  if (options.grid_bits > 0) {
    const double scale = std::ldexp(1.0, options.grid_bits);
    shape.vertices = (shape.vertices.array() * scale).round() / scale;
  }
  for (int part = 0; part < options.parts; ++part)
    shape.part_names.push_back("part_" + std::to_string(part + 1));
  return shape;
}

Shape subdivided(const Shape& shape) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> midpoints;
  std::vector<Eigen::RowVector3d> added;
  const auto midpoint = [&](std::int32_t a, std::int32_t b) {
    const auto next =
        static_cast<std::int32_t>(shape.vertex_count() + static_cast<Eigen::Index>(added.size()));
    const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), next);
    if (is_new) added.push_back((shape.vertices.row(a) + shape.vertices.row(b)) / 2);
    return entry->second;
  };
  Shape result = shape;
  result.triangles.resize(4 * shape.triangle_count(), 3);
  result.triangle_part.clear();
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const std::int32_t a = shape.triangles(t, 0), b = shape.triangles(t, 1), c = shape.triangles(t, 2);
    const std::int32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    result.triangles.middleRows<4>(4 * t) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    result.triangle_part.insert(result.triangle_part.end(), 4,
                                shape.triangle_part[static_cast<std::size_t>(t)]);
  }
  result.vertices.conservativeResize(shape.vertex_count() + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i)
    result.vertices.row(shape.vertex_count() + static_cast<Eigen::Index>(i)) = added[i];
  return result;
}

namespace {

std::vector<std::int32_t> shuffled(Eigen::Index count, Random& random) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

Shape permuted(const Shape& shape, std::uint64_t seed) {
  Random random(seed);
  const std::vector<std::int32_t> new_row = shuffled(shape.vertex_count(), random);
  const std::vector<std::int32_t> old_triangle = shuffled(shape.triangle_count(), random);
  Shape result = shape;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    result.vertices.row(new_row[static_cast<std::size_t>(v)]) = shape.vertices.row(v);
  for (std::size_t t = 0; t < old_triangle.size(); ++t) {
    const int first = static_cast<int>(random.below(3));
    for (int k = 0; k < 3; ++k)
      result.triangles(static_cast<Eigen::Index>(t), k) =
          new_row[static_cast<std::size_t>(shape.triangles(old_triangle[t], (k + first) % 3))];
    result.triangle_part[t] = shape.triangle_part[static_cast<std::size_t>(old_triangle[t])];
  }
  return result;
}

Shape flipped(const Shape& shape) {
  Shape result = shape;
  result.triangles.col(1) = shape.triangles.col(2);
  result.triangles.col(2) = shape.triangles.col(1);
  return result;
}

Shape moved(const Shape& shape, const Eigen::Vector3d& by) {
  return transformed(shape, Eigen::Matrix3d::Identity(), by);
}

Shape named(Shape shape, const std::string& name) {
  shape.part_names = {name};
  return shape;
}

Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  Random random(seed);
  for (;;) {
    const Eigen::Vector3d a = random.in_cube();
    const Eigen::Vector4d q(a.x(), a.y(), a.z(), random.uniform(-1, 1));
    if (q.squaredNorm() > 0.01 && q.squaredNorm() <= 1)
      return Eigen::Quaterniond(q).normalized().toRotationMatrix();
  }
}

double signed_volume(const Shape& shape) {
  double volume = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    volume += shape.corner(t, 0).dot(shape.corner(t, 1).cross(shape.corner(t, 2))) / 6;
  return volume;
}

double surface_area(const Shape& shape) {
  double area = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d a = shape.corner(t, 0);
    area += (shape.corner(t, 1) - a).cross(shape.corner(t, 2) - a).norm() / 2;
  }
  return area;
}

bool is_closed(const Shape& shape) {
  std::set<std::array<std::int32_t, 3>> edges;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
      if (!edges.insert({part, shape.triangles(t, k), shape.triangles(t, (k + 1) % 3)}).second) return false;
    }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.count({edge[0], edge[2], edge[1]}) == 1;
  });
}

}  // namespace stackabilization::solids
