#include "apps/deformation_models.h"

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/iwires_model.h"
#include "stackabilization/deformation/surface_model.h"

namespace stackabilization::apps {

namespace {

/// Feature curves that keep the symmetries of the whole.
std::unique_ptr<DeformationModel> wires_of(const StructuredShape& rest) {
  IWiresOptions options;
  options.relations.symmetries = rest.structure.symmetries;
  return std::make_unique<IWiresModel>(rest.shape, options);
}

}  // namespace

std::unique_ptr<DeformationModel> make_deformation_model(const DeformCommandOptions& options,
                                                         const StructuredShape& rest) {
  switch (options.kind) {
    case ModelKind::controllers:
      return std::make_unique<ControllerModel>(rest);
    case ModelKind::surface:
      return surface_model(rest.shape);
    case ModelKind::iwires:
      return wires_of(rest);
    case ModelKind::gap_scaling:
      return gap_scaling(rest.shape, Direction(options.direction.value_or(Eigen::Vector3d::UnitZ())));
  }
  throw UsageError("an unknown deformation model was asked for");
}

std::vector<std::vector<std::int32_t>> edited_curves(const DeformationModel& model,
                                                     const std::vector<Edit>& edits) {
  std::vector<std::vector<std::int32_t>> curves;
  const auto* const wires = dynamic_cast<const IWiresModel*>(&model);
  if (wires == nullptr) return curves;
  for (const Edit& edit : edits)
    if (edit.handle.kind == HandleKind::wire) {
      const FeatureCurve& curve = wires->wires().wires.at(static_cast<std::size_t>(edit.handle.index)).curve;
      curves.emplace_back(curve.vertices.begin(), curve.vertices.end());
      if (curve.closed) curves.back().push_back(curve.vertices.front());
    }
  return curves;
}

}  // namespace stackabilization::apps
