#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "improvement/quality/flat_faces.h"
#include "improvement/quality/part_form.h"
#include "improvement/quality/thickness.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/improvement/quality.h"

namespace stackabilization::detail {

/// The form of each part by itself: the measures straightness, bending, section, profile, flatness,
/// parallelism, size, small_part, thickness and lean.
class PartForms {
 public:
  /// Prepares what depends on the object at rest. `up`: unit.
  PartForms(const StructuredShape& rest, const WeldedMesh& welded, const Eigen::Vector3d& up);

  /// Returns the best affine map of each part; the identity for a part without area.
  std::vector<AffineMap> maps(const Shape& now) const;
  /// Takes the ten measures, in their order. `maps`: those of `now`.
  std::vector<QualityValue> measure(const Shape& now, const std::vector<AffineMap>& maps) const;
  /// Returns the flat faces of a part, largest first.
  const std::vector<FlatFace>& faces(int part) const { return forms_[static_cast<std::size_t>(part)].faces; }

 private:
  struct Form : PartForm {
    bool small = false;
    std::optional<double> lean;  ///< of a leg or post: at rest or what nobody minds, degrees
    bool hollow = false;         ///< most probes of thickness cross a wall, not the part
    std::vector<FlatFace> faces;
    std::vector<ParallelFaces> parallel;
  };

  static std::vector<double> stretches(const Form& form, const AffineMap& map, double length);
  void measure_faces(const Shape& now, int part, std::vector<QualityValue>& values) const;

  /// Keeps the probes of a part that tell its thickness, and finds out whether it is hollow.
  void keep_probes(const Shape& shape, Form& form, std::vector<ThicknessProbe> probes);
  /// Returns the angle between a line and up, degrees.
  double lean_of(const Eigen::Vector3d& line) const;

  Eigen::Vector3d up_;
  double visible_ = 0;       ///< displacement that a person sees, model units
  std::vector<Form> forms_;  ///< per part
  std::vector<ThicknessProbe> probes_;
};

}  // namespace stackabilization::detail
