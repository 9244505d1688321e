#include "stackabilization/deformation/deformation_model.h"

#include <array>
#include <utility>

#include "stackabilization/deformation/relation_residual.h"

namespace stackabilization {

namespace {

struct KindEntry {
  const char* name;
  DeformationCapabilities capabilities;
};

/// In the order of DeformationKind.
constexpr std::array<KindEntry, 4> kind_entries = {
    {{"controllers", {.edits_primitives = true, .edits_symmetric_parts = true}},
     {"surface", {}},
     {"iwires", {.edits_symmetric_parts = true}},
     {"gap-scaling", {.edits_symmetric_parts = true, .edits_along_one_direction = true}}}};

const KindEntry& entry_of(DeformationKind kind) {
  return kind_entries.at(static_cast<std::size_t>(kind));
}

}  // namespace

const std::vector<DeformationKind>& deformation_kinds() {
  static const std::vector<DeformationKind> kinds = {DeformationKind::controllers, DeformationKind::surface,
                                                     DeformationKind::iwires, DeformationKind::gap_scaling};
  return kinds;
}

std::string name_of(DeformationKind kind) {
  return entry_of(kind).name;
}

const DeformationCapabilities& capabilities_of(DeformationKind kind) {
  return entry_of(kind).capabilities;
}

Design DeformationModel::at_rest() const {
  Design design{{}, {}, rest().shape};
  for (const Part& part : rest().structure.parts) design.primitives.push_back(part.primitive);
  return design;
}

std::vector<Eigen::Vector3d> DeformationModel::centres() const {
  std::vector<Eigen::Vector3d> centres;
  for (const Handle& handle : handles()) centres.push_back(centre(handle));
  return centres;
}

std::vector<std::int32_t> DeformationModel::curve(const Handle&) const {
  return {};
}

DeformationResult DeformationModel::deformed(const std::vector<Edit>& edits,
                                             const DeformationConstraints& constraints) const {
  DeformationResult result{std::nullopt, at_rest()};
  for (const Edit& edit : edits) {
    result = edited(result.design, edit, constraints);
    if (result.refusal) break;
  }
  return result;
}

std::vector<double> DeformationModel::relation_residuals(const Design& design) const {
  return capabilities().edits_primitives
             ? stackabilization::relation_residuals(rest().structure, design.primitives)
             : mesh_relation_residuals(rest(), design.shape);
}

}  // namespace stackabilization
