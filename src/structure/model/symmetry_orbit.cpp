#include "structure/model/symmetry_orbit.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// The symmetry group of the icosahedron has 120 members. It is the largest finite group that is not a
/// symmetry group of a body of revolution.
constexpr std::size_t max_group_size = 120;

class OrbitFinder {
 public:
  explicit OrbitFinder(const Structure& structure)
      : structure_(structure),
        relations_of_(structure.parts.size()),
        place_(structure.parts.size(), -1),
        orbit_of_(structure.parts.size(), -1),
        in_tree_(structure.relations.size(), false) {
    for (std::size_t r = 0; r < structure.relations.size(); ++r) {
      const Relation& relation = structure.relations[r];
      if (!is_symmetry(relation)) continue;
      for (const int part : relation.parts) relations_of_[static_cast<std::size_t>(part)].push_back(r);
    }
  }

  OrbitsOrContradiction run() {
    for (std::size_t part = 0; part < structure_.parts.size(); ++part)
      if (orbit_of_[part] < 0 && !relations_of_[part].empty()) grow(static_cast<int>(part));
    for (Orbit& orbit : result_.orbits) close_group(orbit);
    return std::move(result_);
  }

 private:
  static bool is_symmetry(const Relation& relation) {
    return relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
  }

  void reach(int part, const Eigen::Isometry3d& from_first) {
    Orbit& orbit = result_.orbits.back();
    orbit_of_[static_cast<std::size_t>(part)] = static_cast<int>(result_.orbits.size()) - 1;
    place_[static_cast<std::size_t>(part)] = static_cast<int>(orbit.parts.size());
    orbit.parts.push_back(part);
    orbit.from_first.push_back(from_first);
  }

  void grow(int first) {
    result_.orbits.emplace_back();
    reach(first, Eigen::Isometry3d::Identity());
    for (std::size_t k = 0; k < result_.orbits.back().parts.size(); ++k) {
      const int part = result_.orbits.back().parts[k];
      const Eigen::Isometry3d here = result_.orbits.back().from_first[k];
      for (const std::size_t r : relations_of_[static_cast<std::size_t>(part)]) {
        const Relation& relation = structure_.relations[r];
        if (relation.type != RelationType::symmetry) continue;
        const Eigen::Isometry3d map = isometry_of(relation.symmetry);
        const bool forward = relation.parts[0] == part;
        const int other = relation.parts[forward ? 1 : 0];
        if (orbit_of_[static_cast<std::size_t>(other)] >= 0) continue;
        tree_.push_back(r);
        in_tree_[r] = true;
        reach(other, (forward ? map : map.inverse()) * here);
      }
    }
  }

  Eigen::Isometry3d from_first(int part) const {
    const auto p = static_cast<std::size_t>(part);
    return result_.orbits[static_cast<std::size_t>(orbit_of_[p])]
        .from_first[static_cast<std::size_t>(place_[p])];
  }

  /// Largest relevant coordinate: rounding errors are proportional to it.
  double scale(const Orbit& orbit) const {
    const Points points =
        control_points(structure_.parts[static_cast<std::size_t>(orbit.parts[0])].primitive);
    return points.cwiseAbs().maxCoeff() + structure_.diagonal;
  }

  bool same(const Orbit& orbit, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    const Points points =
        control_points(structure_.parts[static_cast<std::size_t>(orbit.parts[0])].primitive);
    const double limit = tolerance::relative * scale(orbit);
    const Eigen::Vector3d middle = points.colwise().mean().transpose();
    return (a * middle - b * middle).norm() <= limit &&
           (a.linear() - b.linear()).norm() <= tolerance::relative;
  }

  /// The symmetries of its parts, in their order.
  std::vector<std::size_t> relations_of(const Orbit& orbit) const {
    std::vector<std::size_t> rows;
    for (const int part : orbit.parts) {
      const std::vector<std::size_t>& some = relations_of_[static_cast<std::size_t>(part)];
      rows.insert(rows.end(), some.begin(), some.end());
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }

  void close_group(Orbit& orbit) {
    orbit.group = {Eigen::Isometry3d::Identity()};
    std::vector<Eigen::Isometry3d> generators;
    std::vector<int> relations;
    for (const std::size_t r : relations_of(orbit)) {
      const Relation& relation = structure_.relations[r];
      if (in_tree_[r]) continue;
      const Eigen::Isometry3d generator = from_first(relation.parts.back()).inverse() *
                                          isometry_of(relation.symmetry) * from_first(relation.parts.front());
      relations.push_back(static_cast<int>(r));
      if (contains(orbit, generator)) continue;
      generators.push_back(generator);
      if (generate(orbit, generators)) continue;
      contradict(relations);
      return;
    }
  }

  bool contains(const Orbit& orbit, const Eigen::Isometry3d& map) const {
    return std::any_of(orbit.group.begin(), orbit.group.end(),
                       [&](const auto& one) { return same(orbit, one, map); });
  }

  bool generate(Orbit& orbit, const std::vector<Eigen::Isometry3d>& generators) const {
    for (std::size_t k = 0; k < orbit.group.size(); ++k)
      for (const Eigen::Isometry3d& generator : generators) {
        const Eigen::Isometry3d product = generator * orbit.group[k];
        if (!contains(orbit, product)) orbit.group.push_back(product);
        if (orbit.group.size() > max_group_size) return false;
      }
    return true;
  }

  void contradict(const std::vector<int>& relations) {
    if (result_.contradiction) {
      result_.contradiction->dispensable.push_back(relations.back());
      return;
    }
    Contradiction contradiction;
    contradiction.dispensable = {relations.back()};
    const auto orbit_of = [&](std::size_t r) {
      return orbit_of_[static_cast<std::size_t>(structure_.relations[r].parts[0])];
    };
    const int orbit = orbit_of(static_cast<std::size_t>(relations.back()));
    for (const std::size_t r : tree_)
      if (orbit_of(r) == orbit) contradiction.relations.push_back(static_cast<int>(r));
    contradiction.relations.insert(contradiction.relations.end(), relations.begin(), relations.end());
    for (std::size_t k = 0; k < contradiction.relations.size(); ++k) {
      if (k > 0) contradiction.reason += k + 1 < contradiction.relations.size() ? ", " : " and ";
      contradiction.reason += describe(structure_, contradiction.relations[k]);
    }
    contradiction.reason += contradiction.relations.size() > 1
                                ? " contradict each other: together they would move a part off itself"
                                : " contradicts itself: it would move the part off itself";
    result_.contradiction = contradiction;
  }

  const Structure& structure_;
  std::vector<std::vector<std::size_t>> relations_of_;  ///< symmetries per part, in their order
  std::vector<int> place_;                              ///< per part, in its orbit
  std::vector<int> orbit_of_;                           ///< per part; -1 without symmetry
  std::vector<std::size_t> tree_;
  std::vector<bool> in_tree_;  ///< per relation
  OrbitsOrContradiction result_;
};

}  // namespace

OrbitsOrContradiction find_orbits(const Structure& structure) {
  return OrbitFinder(structure).run();
}

std::string describe(const Structure& structure, int relation) {
  return "relation " + std::to_string(relation) + " (" +
         describe(structure.relations[static_cast<std::size_t>(relation)], structure) + ")";
}

}  // namespace stackabilization::detail
