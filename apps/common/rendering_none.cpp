#include "apps/common/rendering.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

namespace {

[[noreturn]] void refuse_rendering() {
  throw UsageError(
      "this program was built without rendering, so there is no --picture and no --method gl-raster "
      "(build with STACKABILIZATION_BUILD_RENDERING=ON)");
}

}  // namespace

void require_rendering() {
  refuse_rendering();
}

HeightField depth_buffer_field(const Shape&, const Direction&, const Window&) {
  refuse_rendering();
}

DepthBufferMaker depth_buffer_maker(const Shape&) {
  return {std::nullopt, "built without rendering"};
}

void write_measurement_picture(const PictureFile&, const Shape&, const Measurement&) {
  refuse_rendering();
}

void write_map_picture(const PictureFile&, const StackabilityMap&) {
  refuse_rendering();
}

void write_drop_picture(const PictureFile&, DropView) {
  refuse_rendering();
}

void write_draft_picture(const PictureFile&, const DraftView&) {
  refuse_rendering();
}

void write_stack_picture(const PictureFile&, const PlacedCopies&) {
  refuse_rendering();
}

void write_structure_picture(const PictureFile&, const StructuredShape&) {
  refuse_rendering();
}

void write_deformation_picture(const PictureFile&, const EditedShape&) {
  refuse_rendering();
}

void write_design_sheet(const PictureFile&, const DesignSheet&) {
  refuse_rendering();
}

std::string rendering_missing() {
  return "this program was built without rendering";
}

void write_improvement_picture(const PictureFile&, const ComparedDesigns&) {
  refuse_rendering();
}

void write_front_picture(const PictureFile&, const std::vector<Eigen::Vector2d>&) {
  refuse_rendering();
}

void write_stacks_picture(const PictureFile&, const ComparedDesigns&, int) {
  refuse_rendering();
}

}  // namespace stackabilization::apps
