#include "stackabilization/deformation/factory.h"

#include <string>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/iwires_model.h"
#include "stackabilization/deformation/surface_model.h"

namespace stackabilization {

std::unique_ptr<DeformationModel> deformation_model(StructuredShape rest,
                                                    const DeformationModelOptions& options) {
  if (rest.structure.parts.size() > options.limits.max_parts)
    throw InputError("it has " + std::to_string(rest.structure.parts.size()) +
                     " parts, and designs are made of at most " + std::to_string(options.limits.max_parts));
  validate(rest);
  switch (options.kind) {
    case DeformationKind::controllers:
      return std::make_unique<ControllerModel>(
          std::move(rest), ControllerLimits{options.limits.max_joint_points}, options.following);
    case DeformationKind::surface: {
      SurfaceModelOptions surface;
      if (options.direction) surface.axis = options.direction->unit();
      return surface_model(std::move(rest), surface);
    }
    case DeformationKind::iwires: {
      IWiresOptions wires;
      wires.relations.symmetries = rest.structure.symmetries;
      return std::make_unique<IWiresModel>(std::move(rest), wires);
    }
    case DeformationKind::gap_scaling:
      return gap_scaling(std::move(rest), options.direction.value_or(Direction(0, 0, 1)));
  }
  throw UsageError("an unknown deformation model was asked for");
}

}  // namespace stackabilization
