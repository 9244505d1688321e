#include "stackabilization/structure/analysis.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "core/bounding_diagonal.h"
#include "core/extract_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "structure/analysis/joint_symmetry.h"
#include "structure/analysis/symmetrize.h"
#include "structure/model/symmetry_orbit.h"
#include "structure/segmentation/segment.h"

namespace stackabilization {

namespace {

PrimitiveKind kind_of(const Primitive& primitive) {
  return std::holds_alternative<Cuboid>(primitive) ? PrimitiveKind::cuboid : PrimitiveKind::cylinder;
}

double error_of(const PrimitiveFit& fit, PrimitiveKind kind) {
  if (kind == PrimitiveKind::cuboid) return fit.cuboid_error;
  return fit.cylinder_error.value_or(std::numeric_limits<double>::infinity());
}

class Analysis {
 public:
  Analysis(const Shape& shape, const AnalysisOptions& options) : options_(options) {
    report(AnalysisStep::parts, 0);
    result_.shape = detail::segment(shape, options.segmentation, [&] { return symmetries(shape); });
    if (names().size() > options.max_parts)
      throw InputError("it has " + std::to_string(names().size()) + " parts, and the structure of at most " +
                       std::to_string(options.max_parts) + " is analysed");
    near_parts(result_.shape, options.joints);
    parts_ = extract_parts(result_.shape);
    const std::set<std::string> known(names().begin(), names().end());
    for (const auto& [name, kind] : options.kinds)
      if (!known.contains(name))
        throw UsageError("a kind of primitive is given for a part, and " + unknown_part(names(), name));
  }

  StructuredShape run() {
    fit_parts();
    find_relations();
    agree_on_kinds();
    drop_contradictions();
    add_joints();
    return std::move(result_);
  }

 private:
  const std::vector<std::string>& names() const { return result_.shape.part_names; }
  Structure& structure() { return result_.structure; }
  Part& part(int row) { return structure().parts[static_cast<std::size_t>(row)]; }

  std::optional<PrimitiveKind> forced_kind(int row) const {
    const auto forced = options_.kinds.find(names()[static_cast<std::size_t>(row)]);
    return forced == options_.kinds.end() ? options_.fit.kind : forced->second;
  }

  void fit_part(int row, std::optional<PrimitiveKind> kind) {
    FitOptions options = options_.fit;
    options.kind = kind;
    FittedPrimitive fitted = fit_primitive(parts_[static_cast<std::size_t>(row)], options);
    part(row) = {names()[static_cast<std::size_t>(row)], std::move(fitted.primitive), std::move(fitted.fit)};
  }

  void fit_parts() {
    structure().diagonal = bounding_diagonal(result_.shape);
    structure().parts.resize(names().size());
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, names().size(), [&](std::size_t k) {
      const int row = static_cast<int>(k);
      fit_part(row, forced_kind(row));
      report(AnalysisStep::primitives, static_cast<double>(++done) / static_cast<double>(names().size()));
    });
  }

  /// Returns the symmetries of the whole, which do not depend on its parts.
  const std::vector<FoundSymmetry>& symmetries(const Shape& shape) {
    if (!symmetries_) symmetries_ = find_symmetries(shape, options_.symmetry);
    return *symmetries_;
  }

  void find_relations() {
    report(AnalysisStep::symmetries, 0);
    const std::vector<FoundSymmetry>& found = symmetries(result_.shape);
    for (const FoundSymmetry& one : found) structure().symmetries.push_back(one.symmetry);
    structure().relations = symmetry_relations(result_.shape, found, options_.symmetry);
    std::stable_sort(structure().relations.begin(), structure().relations.end(),
                     [](const Relation& a, const Relation& b) { return a.parts < b.parts; });
  }

  /// Returns the kind of primitive of symmetric parts: the kind that one of them is forced to, otherwise the
  /// kind with the smaller sum of errors over all of them.
  void agree_on_kinds() {
    for (const detail::Orbit& orbit : detail::find_orbits(structure()).orbits) {
      const PrimitiveKind kind = common_kind(orbit);
      tbb::parallel_for(std::size_t{0}, orbit.parts.size(), [&](std::size_t k) {
        if (kind_of(part(orbit.parts[k]).primitive) != kind) fit_part(orbit.parts[k], kind);
      });
    }
  }

  PrimitiveKind common_kind(const detail::Orbit& orbit) {
    std::optional<PrimitiveKind> forced;
    for (const int row : orbit.parts) {
      const std::optional<PrimitiveKind> kind = forced_kind(row);
      if (forced && kind && forced != kind)
        throw UsageError("part '" + part(row).name +
                         "' is symmetric to others that are forced to another kind of primitive");
      if (kind) forced = kind;
    }
    if (forced) return *forced;
    const PrimitiveKind first = kind_of(part(orbit.parts.front()).primitive);
    if (std::all_of(orbit.parts.begin(), orbit.parts.end(),
                    [&](int row) { return kind_of(part(row).primitive) == first; }))
      return first;
    double cuboid = 0, cylinder = 0;
    for (const int row : orbit.parts) {
      cuboid += error_of(part(row).fit, PrimitiveKind::cuboid);
      cylinder += error_of(part(row).fit, PrimitiveKind::cylinder);
    }
    return cylinder < cuboid ? PrimitiveKind::cylinder : PrimitiveKind::cuboid;
  }

  /// Removes relations until none contradict each other. Each symmetry was found separately, and primitives
  /// may not be able to satisfy all of them; the last one found is removed. A removal may resolve other
  /// contradictions, so relations are removed one at a time. When that would take too long, one relation of
  /// every orbit is removed at a time.
  void drop_contradictions() {
    constexpr std::size_t max_relations_looked_at = 20'000;
    for (std::size_t looked_at = 0;;) {
      Structure ideal = structure();
      const std::optional<detail::Contradiction> contradiction = detail::try_symmetrize(ideal);
      if (!contradiction) {
        structure() = std::move(ideal);
        return;
      }
      std::vector<int> rows = {contradiction->relations.back()};
      looked_at += structure().relations.size();
      if (looked_at > max_relations_looked_at) rows = contradiction->dispensable;
      std::sort(rows.begin(), rows.end());
      for (auto row = rows.rbegin(); row != rows.rend(); ++row)
        structure().relations.erase(structure().relations.begin() + *row);
    }
  }

  void add_joints() {
    report(AnalysisStep::joints, 0);
    std::vector<Relation> joints =
        detail::symmetric_joints(find_joints(result_.shape, structure().parts, options_.joints), structure());
    std::stable_sort(joints.begin(), joints.end(),
                     [](const Relation& a, const Relation& b) { return a.parts < b.parts; });
    structure().relations.insert(structure().relations.end(), joints.begin(), joints.end());
  }

  /// Reports progress from the calling thread only.
  void report(AnalysisStep step, double fraction) const {
    if (options_.progress && std::this_thread::get_id() == caller_) options_.progress(step, fraction);
  }

  const AnalysisOptions& options_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::vector<Shape> parts_;  ///< of the shape
  std::optional<std::vector<FoundSymmetry>> symmetries_;
  StructuredShape result_;
};

}  // namespace

StructuredShape analyse_structure(const Shape& shape, const AnalysisOptions& options) {
  validate(shape);
  return Analysis(shape, options).run();
}

}  // namespace stackabilization
