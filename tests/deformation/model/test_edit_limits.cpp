#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/iwires_model.h"
#include "stackabilization/deformation/surface_model.h"
#include "support/catch.h"
#include "support/handles.h"
#include "support/messages.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double full_turn = 2 * std::numbers::pi;
const Eigen::Vector3d box_size(4, 1, 2);
struct NamedModel {
  std::string name;
  std::unique_ptr<DeformationModel> model;
};

/// Every model, for a box.
std::vector<NamedModel> models() {
  const StructuredShape rest = structures::box_alone(box_size);
  std::vector<NamedModel> all;
  all.push_back({"controllers", std::make_unique<ControllerModel>(rest)});
  all.push_back({"surface", surface_model(rest)});
  all.push_back({"iwires", std::make_unique<IWiresModel>(rest)});
  all.push_back({"gap scaling", gap_scaling(rest, Direction(0, 0, 1))});
  return all;
}

/// Sizes of axes that a Direction takes.
const std::vector<double> good_lengths = {1e-153, 1e-100, 1e-10, 0.3, 7, 1e10, 1e100, 1e153};
/// Sizes whose squares overflow or underflow, or are less than nothing of the kind.
const std::vector<double> bad_lengths = {
    0, 5e-324, 1e-310, 1e-300, 1e-170, 1e170, 1e300, std::numeric_limits<double>::max(), infinite, NAN};

}  // namespace

TEST_CASE("an axis means its direction, however long it is, or is refused") {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized(), up(0, 0, 1);
  for (const NamedModel& named : models()) {
    const bool gap = named.name == "gap scaling";
    const Eigen::Vector3d along = gap ? up : axis;
    const DeformationModel& model = *named.model;
    const auto rotated = [&](double length) {
      return model.deformed({{whole_shape, Rotate{length * along, 0.7}}});
    };
    const auto scaled = [&](double length) {
      return model.deformed({{whole_shape, Scale{1.5, Eigen::Vector3d(length * along)}}});
    };
    for (const double length : good_lengths) {
      INFO(named.name << ", axis of length " << length);
      const double slack = 1e-14 * box_size.norm();
      CHECK((scaled(length).design.shape.vertices - scaled(1).design.shape.vertices).cwiseAbs().maxCoeff() <=
            slack);
      if (!gap)
        CHECK((rotated(length).design.shape.vertices - rotated(1).design.shape.vertices)
                  .cwiseAbs()
                  .maxCoeff() <= slack);
    }
    for (const double length : bad_lengths) {
      INFO(named.name << ", axis of length " << length);
      CHECK(message_of<UsageError>([&] { rotated(length); }).find("a rotation needs an axis") == 0);
      CHECK(message_of<UsageError>([&] { scaled(length); }).find("a scaling along an axis needs an axis") ==
            0);
    }
  }
}

TEST_CASE("moves, factors and angles beyond their limits are refused by every model") {
  const double diagonal = box_size.norm();
  const std::vector<std::pair<Operation, std::string>> cases = {
      {Move{{1.001 * edit_limits::max_move * diagonal, 0, 0}}, "a move goes at most 1000 times the diagonal"},
      {Move{{0, -1e300, 1e300}}, "a move goes at most"},
      {Move{{0, infinite, 0}}, "a move needs a finite translation"},
      {Scale{1.001 * edit_limits::max_scale, {}}, "a scaling needs a factor from 1e-06 to 1000000, found"},
      {Scale{0.999 / edit_limits::max_scale, {}}, "a scaling needs a factor from"},
      {Scale{1e300, {}}, "a scaling needs a factor from"},
      {Scale{infinite, {}}, "a scaling needs a factor from"},
      {Scale{5e-324, {}}, "a scaling needs a factor from"},
      {Scale{-2, {}}, "a scaling needs a positive factor, found -2"},
      {Scale{NAN, {}}, "a scaling needs a positive factor"},
      {Rotate{{0, 0, 1}, 10.01 * full_turn},
       "a rotation needs an angle from -3600 to 3600 degrees, found 3603.6"},
      {Rotate{{0, 0, 1}, -1e300}, "a rotation needs an angle"},
      {Rotate{{0, 0, 1}, NAN}, "a rotation needs an angle"}};
  for (const NamedModel& named : models())
    for (const auto& [operation, words] : cases) {
      if (named.name == "gap scaling" && std::holds_alternative<Move>(operation)) continue;
      const Edit edit{whole_shape, operation};
      const std::string found = message_of<UsageError>([&] { named.model->deformed({edit}); });
      INFO(named.name << ": " << found);
      CHECK(found.find(words) == 0);
    }
}

TEST_CASE("edits at their limits are made, and are finite and right") {
  const ControllerModel model(structures::box_alone(box_size));
  const Points rest = model.rest().shape.vertices;
  const Eigen::Vector3d far(edit_limits::max_move * box_size.norm(), 0, 0);
  const Points moved = model.deformed({{whole_shape, Move{far}}}).design.shape.vertices;
  CHECK(((moved.rowwise() - far.transpose()) - rest).cwiseAbs().maxCoeff() < 1e-9);
  const Points turned =
      model.deformed({{whole_shape, Rotate{{0, 0, 1}, -10 * full_turn}}}).design.shape.vertices;
  CHECK((turned - rest).cwiseAbs().maxCoeff() < 1e-12);
  for (const NamedModel& named : models())
    for (const double factor : {1 / edit_limits::max_scale, edit_limits::max_scale}) {
      INFO(named.name << " by " << factor);
      std::vector<Edit> edits;
      // So often that nothing, or everything, would be left.
      for (int k = 0; k < 60; ++k) {
        edits.push_back({whole_shape, Scale{factor, Eigen::Vector3d(0, 0, 1)}});
        const DeformationResult result = named.model->deformed(edits);
        REQUIRE(result.design.shape.vertices.allFinite());
        if (!result.refusal) validate(result.design.shape);
      }
    }
}

TEST_CASE("what no model keeps is refused at the door: points far away, odd tolerances") {
  const std::vector<std::pair<Eigen::Vector3d, bool>> points = {
      {{2, 0.5, 1}, true},         {{-30, 0.5, 1}, true},     {{2, 0.5, 60}, false}, {{1e300, 0, 0}, false},
      {{0, -1e300, 1e300}, false}, {{0, infinite, 0}, false}, {{0, NAN, 0}, false}};
  for (const NamedModel& named : models()) {
    const Edit edit{whole_shape, Scale{1, Eigen::Vector3d(0, 0, 1)}};
    for (const auto& [point, good] : points) {
      INFO(named.name << ", point " << point.transpose());
      DeformationConstraints constraints;
      constraints.fixed_points = {point};
      const std::string found = message_of<UsageError>([&] { named.model->deformed({edit}, constraints); });
      CHECK(found.find(good ? "accepted" : "a fixed point lies on the surface, or at most") == 0);
    }
    for (const double tolerance : {-1e-300, -1.0, infinite, std::nan("")}) {
      DeformationConstraints constraints;
      constraints.box_tolerance = tolerance;
      CHECK(message_of<UsageError>([&] {
              named.model->deformed({edit}, constraints);
            }).find("the tolerance of the box") == 0);
    }
  }
}
