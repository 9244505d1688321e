#include "stackabilization/improvement/design.h"

#include "improvement/design/carried_primitives.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/iwires_model.h"
#include "stackabilization/deformation/surface_model.h"

namespace stackabilization {

namespace {

std::vector<Edit> with(std::vector<Edit> edits, const Edit& edit) {
  edits.push_back(edit);
  return edits;
}

/// Designs of controllers. An edit starts from the primitives of the design.
class ControllerDesigns : public DesignSpace {
 public:
  ControllerDesigns(StructuredShape rest, Following following)
      : model_(std::move(rest), {max_design_joint_points}, following), following_(following) {}

  const StructuredShape& rest() const override { return model_.rest(); }
  DeformationKind kind() const override { return DeformationKind::controllers; }
  Following following() const override { return following_; }
  std::vector<Handle> handles() const override { return model_.handles(); }
  Design at_rest() const override { return {{}, model_.rest_primitives(), model_.rest().shape}; }

  DesignOutcome edited(const Design& now, const Edit& edit,
                       const DeformationConstraints& constraints) const override {
    EditOutcome outcome = model_.edited(now.primitives, edit, constraints);
    if (outcome.refusal) return {std::move(outcome.refusal), now};
    Shape shape = model_.shape_of(outcome.primitives);
    return {std::nullopt, {with(now.edits, edit), std::move(outcome.primitives), std::move(shape)}};
  }

  /// Makes the mesh once, at the end: it depends on the primitives only.
  DesignOutcome replayed(const std::vector<Edit>& edits,
                         const DeformationConstraints& constraints) const override {
    DesignOutcome result{std::nullopt, {{}, model_.rest_primitives(), {}}};
    for (const Edit& edit : edits) {
      EditOutcome outcome = model_.edited(result.design.primitives, edit, constraints);
      if (outcome.refusal) {
        result.refusal = std::move(outcome.refusal);
        break;
      }
      result.design.primitives = std::move(outcome.primitives);
      result.design.edits.push_back(edit);
    }
    result.design.shape =
        result.design.edits.empty() ? model_.rest().shape : model_.shape_of(result.design.primitives);
    return result;
  }

 private:
  ControllerModel model_;
  Following following_;
};

/// Designs of models without primitives. Every design is made from rest, with all of its edits.
class CarriedDesigns : public DesignSpace {
 public:
  CarriedDesigns(StructuredShape rest, DeformationKind kind, std::unique_ptr<DeformationModel> model)
      : rest_(std::move(rest)), kind_(kind), model_(std::move(model)), primitives_(rest_) {
    for (const Handle& handle : model_->handles()) centres_.push_back(model_->centre(handle));
  }

  const StructuredShape& rest() const override { return rest_; }
  DeformationKind kind() const override { return kind_; }
  std::vector<Handle> handles() const override { return model_->handles(); }
  std::vector<Eigen::Vector3d> centres() const override { return centres_; }
  Design at_rest() const override { return {{}, primitives_.at(rest_.shape.vertices), rest_.shape}; }

  DesignOutcome edited(const Design& now, const Edit& edit,
                       const DeformationConstraints& constraints) const override {
    std::vector<Edit> edits = with(now.edits, edit);
    DeformationResult result = model_->deformed(edits, constraints);
    if (result.refusal) return {std::move(result.refusal), now};
    std::vector<Primitive> primitives = primitives_.at(result.shape.vertices);
    return {std::nullopt, {std::move(edits), std::move(primitives), std::move(result.shape)}};
  }

 private:
  StructuredShape rest_;
  DeformationKind kind_;
  std::unique_ptr<DeformationModel> model_;
  detail::CarriedPrimitives primitives_;
  std::vector<Eigen::Vector3d> centres_;
};

/// Precondition: `options.kind` is not controllers.
std::unique_ptr<DeformationModel> primitiveless_model(const StructuredShape& rest,
                                                      const DesignSpaceOptions& options) {
  switch (options.kind) {
    case DeformationKind::surface: {
      SurfaceModelOptions surface;
      surface.axis = options.direction.unit();
      return surface_model(rest.shape, surface);
    }
    case DeformationKind::iwires: {
      IWiresOptions wires;
      wires.relations.symmetries = rest.structure.symmetries;
      return std::make_unique<IWiresModel>(rest.shape, wires);
    }
    case DeformationKind::gap_scaling:
      return gap_scaling(rest.shape, options.direction);
    case DeformationKind::controllers:
      break;
  }
  throw UsageError("an unknown deformation model was asked for");
}

}  // namespace

std::string name_of(DeformationKind kind) {
  switch (kind) {
    case DeformationKind::controllers:
      return "controllers";
    case DeformationKind::surface:
      return "surface";
    case DeformationKind::iwires:
      return "iwires";
    case DeformationKind::gap_scaling:
      return "gap-scaling";
  }
  return {};
}

DesignOutcome DesignSpace::replayed(const std::vector<Edit>& edits,
                                    const DeformationConstraints& constraints) const {
  DesignOutcome outcome{std::nullopt, at_rest()};
  for (const Edit& edit : edits) {
    outcome = edited(outcome.design, edit, constraints);
    if (outcome.refusal) break;
  }
  return outcome;
}

std::unique_ptr<DesignSpace> design_space(StructuredShape rest, const DesignSpaceOptions& options) {
  if (rest.structure.parts.size() > max_design_parts)
    throw InputError("it has " + std::to_string(rest.structure.parts.size()) +
                     " parts, and designs are made of at most " + std::to_string(max_design_parts));
  if (options.kind == DeformationKind::controllers)
    return std::make_unique<ControllerDesigns>(std::move(rest), options.following);
  validate(rest);
  std::unique_ptr<DeformationModel> model = primitiveless_model(rest, options);
  return std::make_unique<CarriedDesigns>(std::move(rest), options.kind, std::move(model));
}

}  // namespace stackabilization
