#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/deformation/refusal.h"
#include "support/catch.h"

namespace stackabilization {
namespace {

/// Two parts with percent signs and amounts in their names, a symmetry of both and a joint.
Structure two_parts() {
  Structure structure;
  structure.parts = {{"leg 0.5", {}, {}}, {"100 %p", {}, {}}};
  structure.relations.resize(2);
  structure.relations[0] = {.type = RelationType::self_symmetry, .parts = {1}, .symmetry = {}, .points = {}};
  structure.relations[1] = {.type = RelationType::point_joint, .parts = {0, 1}, .symmetry = {}, .points = {}};
  return structure;
}

Refusal refusal(RefusalCause cause) {
  return {.cause = cause,
          .part = 0,
          .relation = 1,
          .index = 2,
          .other = 4,
          .symmetry = 5,
          .axis = {0, -0.6, 0.80004},
          .amount = 0.0123456};
}

TEST_CASE("every cause of a refusal has its sentence") {
  using enum RefusalCause;
  const std::string joint = "the point joint of 'leg 0.5' and '100 %p'", diagonal = "0.0123 of the diagonal",
                    finely = "0.01235 of the diagonal";
  const std::vector<std::pair<RefusalCause, std::string>> sentences = {
      {fixed_part, "'leg 0.5' is fixed, or symmetric to a part that is"},
      {symmetry_of_shape,
       joint + " does not let the shape go where the edit takes it: it would be off by " + diagonal},
      {symmetry, joint + " does not let 'leg 0.5' go where the edit takes it: it would miss by " + diagonal},
      {symmetry_of_turn,
       joint + " does not let 'leg 0.5' go where the edit takes it: it would miss by 0.0123 radians"},
      {relation, joint + " would be off by " + diagonal},
      {primitive_range, "'leg 0.5' would leave the range of numbers"},
      {inverted_corner, "'leg 0.5' is turned inside out at corner 2"},
      {collapsed_corner, "'leg 0.5' collapses at corner 2"},
      {collapsed_radius, "'leg 0.5' loses the radius of cross-section 2"},
      {collapsed_piece, "'leg 0.5' collapses after cross-section 2"},
      {folded_piece, "'leg 0.5' folds after cross-section 2"},
      {fixed_point, "a fixed point would move by " + diagonal},
      {moved_extent, "the extent along (0, -0.6, 0.8) would begin or end elsewhere, off by " + diagonal},
      {long_extent, "the extent along (0, -0.6, 0.8) would be too long by " + diagonal},
      {short_extent, "the extent along (0, -0.6, 0.8) would be too short by " + diagonal},
      {vertex_range, "the edit takes vertex 2 out of the range of numbers"},
      {fixed_vertex, "the edit would move what is to stay fixed (vertex 2) by " + finely},
      {flat_extent, "the edit would flatten the shape along the direction whose extent is kept by " + finely},
      {fixed_low,
       "what is fixed leaves the lower end of the extent no room to be kept: it changes by " + finely},
      {fixed_high,
       "what is fixed leaves the upper end of the extent no room to be kept: it changes by " + finely},
      {box_side, "the edit would change the side of the box along z by " + finely},
      {wire_junction, "wire 2 would come apart from wire 4, by " + diagonal},
      {wire_plane, "wire 2 would leave the plane of wire 4, by " + diagonal},
      {wire_image, "wire 2 would no longer be the image of wire 4 under a symmetry, by " + diagonal},
      {fixed_wire, "wire 2 would leave a point that is to stay, by " + diagonal},
      {wire_extent, "wire 2 would change the extent that is to be kept, by " + diagonal},
      {collapsed_wire, "wire 2 would shrink to nothing or turn inside out, by " + diagonal},
      {wire_symmetry, "symmetry 5 would no longer be one, by 0.0123 of any length"},
      {wire_image_of, "wire 2 would no longer be the image of wire 4 under symmetry 5, by " + diagonal},
      {proportions, "'leg 0.5' would lose its proportions"},
      {unchanged, "nothing would change"},
      {undefined, "stackability or distortion would be undefined"},
      {collapsed_triangle, "triangle 2 loses a side"},
      {uneven_row, "the row around 'leg 0.5' would no longer be even, off by " + diagonal}};
  REQUIRE(sentences.size() == static_cast<std::size_t>(uneven_row) + 1);
  for (std::size_t k = 0; k < sentences.size(); ++k) {
    CHECK(sentences[k].first == static_cast<RefusalCause>(k));
    CHECK(describe(refusal(sentences[k].first), two_parts()) == sentences[k].second);
  }
}

TEST_CASE("refusals of one kind are equal without their amounts, and say so") {
  const Structure structure = two_parts();
  Refusal one = refusal(RefusalCause::relation), other = one;
  other.amount = 1;
  CHECK(one != other);
  CHECK(without_amounts(one) == without_amounts(other));
  CHECK(describe(without_amounts(one), structure) ==
        "the point joint of 'leg 0.5' and '100 %p' would be off");
  other.relation = 0;
  CHECK(without_amounts(one) != without_amounts(other));

  one = other = refusal(RefusalCause::long_extent);
  CHECK(describe(without_amounts(one), structure) == "the extent along (0, ..., ...) would be too long");
  other.axis = {0.0, 0.7, 0.7};
  CHECK(without_amounts(one) == without_amounts(other));
  for (const double nearly : {0.9996, 1.0}) {
    other.axis = {-0.0, 0.0, -nearly};
    CHECK(describe(without_amounts(other), structure) == "the extent along (0, 0, -1) would be too long");
    CHECK(without_amounts(other).axis == std::array<double, 3>{0, 0, -1});
  }
}

TEST_CASE("a refusal of other parts or relations than the structure has is no sentence") {
  Refusal row = refusal(RefusalCause::symmetry);
  row.relation = -1;
  CHECK(describe(row, two_parts()).starts_with("rounding does not let 'leg 0.5' go"));
  row.part = -1;
  CHECK_THROWS_AS(describe(row, two_parts()), std::out_of_range);
  row = refusal(RefusalCause::relation);
  row.relation = 2;
  CHECK_THROWS_AS(describe(row, two_parts()), std::out_of_range);
  row = refusal(RefusalCause::box_side);
  row.index = 3;
  CHECK_THROWS_AS(describe(row, two_parts()), std::out_of_range);
}

}  // namespace
}  // namespace stackabilization
