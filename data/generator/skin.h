#pragma once

#include <array>
#include <vector>

#include "generator/modelling.h"

namespace stackabilization::models {

/// A surface through rings of equally many points.
class Skin {
 public:
  explicit Skin(const std::vector<Ring>& rings);

  /// Joins ring i to ring j, where the surface goes from i to j.
  void join(std::size_t i, std::size_t j);

  enum class End { first, last };
  /// Closes the surface at ring i, its first or last, by shrunken copies of the ring and a fan.
  void cap(std::size_t i, int copies, End end);

  Shape shape() const;

 private:
  struct Fan {
    std::size_t ring;
    Eigen::Vector3d centre;
    End end;
  };

  int id(std::size_t ring, std::size_t k) const { return static_cast<int>(ring * segments_ + k); }
  std::size_t add_ring(const Ring& ring);
  void add_quad(const std::array<int, 4>& corners);

  std::size_t segments_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<Fan> fans_;
};

}  // namespace stackabilization::models
