#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/pictures.h"
#include "support/catch.h"
#include "support/picture_checks.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

MeasuredShape measured_cup(const solids::FrustumShell& cup, const Direction& direction) {
  MeasuredShape measured{solids::frustum_shell(cup), {}, {}};
  measured.measured = stackability(measured.shape, direction);
  const SeparationTree tree(measured.shape);
  const Separation answer = separation(tree, tree, direction);
  measured.contacts = contact_regions({measured.shape, tree, direction, answer}).regions;
  return measured;
}

/// A cup with steep walls, and one with thin slanted ones that goes far into the next.
ImprovedShape cups(const Direction& direction = {0, 0, 1}) {
  solids::FrustumShell after;
  after.outer_bottom = 2;
  after.inner_bottom = 1.8;
  after.inner_top = 3.8;
  return {measured_cup({}, direction), measured_cup(after, direction)};
}

/// The dimensions, bottom to top: "31.2" reads upwards.
std::vector<const Text*> dimensions(const Drawing& drawing) {
  std::vector<const Text*> found;
  for (const DrawingElement& element : drawing.elements)
    if (const auto* text = std::get_if<Text>(&element); text != nullptr && text->upwards)
      found.push_back(text);
  return found;
}

}  // namespace

TEST_CASE("before and after stand side by side with their numbers") {
  const ImprovedShape shapes = cups();
  ImprovementPictureOptions options;
  options.title = "cup.obj";
  options.notes = {"scale section 0 of body by 0.7"};
  const Drawing drawing = improvement_picture(shapes, options);
  check_nothing_clipped(drawing);
  for (const MeasuredShape* side : {&shapes.before, &shapes.after})
    CHECK(says(drawing, std::to_string(side->measured.value).substr(0, 5)));
  CHECK(says(drawing, "h = 8"));
  CHECK(says(drawing, options.notes[0]));
  const Image image = rasterize(drawing);
  CHECK(pixels_of(image, palette::input) > 10000);
  CHECK(pixels_of(image, palette::output) > 10000);
  CHECK(pixels_of(image, palette::contact) > 100);

  ImprovedShape plain = shapes;
  plain.before.contacts.clear();
  plain.after.contacts.clear();
  const Drawing unmarked = improvement_picture(plain, options);
  CHECK(pixels_of(rasterize(unmarked), palette::contact) == 0);
  CHECK(!says(unmarked, "touch"));
  // Where the shapes are in their files does not matter: the green one is as large.
  plain.after.shape = solids::moved(plain.after.shape, {70, -30, 500});
  const int here = pixels_of(rasterize(unmarked), palette::output);
  const int there = pixels_of(rasterize(improvement_picture(plain, options)), palette::output);
  CHECK(std::abs(there - here) < here / 50);
}

TEST_CASE("both stacks are in one scale: dimensions are as long as what they say") {
  for (const Direction& direction : {Direction(0, 0, 1), Direction(0, 0, -3), Direction(0.2, 0.1, 1)}) {
    ImprovedShape shapes = cups(direction);
    shapes.after.shape = solids::moved(shapes.after.shape, {70, -30, 500});
    StacksPictureOptions options;
    options.notes = {"less high"};
    const Drawing drawing = stacks_picture(shapes, options);
    check_nothing_clipped(drawing);
    const std::vector<const Text*> captions = dimensions(drawing);
    REQUIRE(captions.size() == 2);
    const double before = std::stod(captions[0]->text), after = std::stod(captions[1]->text);
    CHECK(before == Approx(shapes.before.measured.extent + 4 * shapes.before.measured.f_max).epsilon(1e-3));
    CHECK(after == Approx(shapes.after.measured.extent + 4 * shapes.after.measured.f_max).epsilon(1e-3));
    CHECK(captions[0]->at.x() < captions[1]->at.x());
    // Captions stand in the middle of their dimensions, which begin at one ground.
    std::vector<double> lengths;
    std::vector<double> grounds;
    for (const DrawingElement& element : drawing.elements)
      if (const auto* line = std::get_if<Polyline>(&element);
          line != nullptr && line->points(0, 0) == line->points(1, 0)) {
        lengths.push_back(std::abs(line->points(0, 1) - line->points(1, 1)));
        grounds.push_back(line->points(0, 1));
      }
    REQUIRE(lengths.size() == 2);
    CHECK(grounds[0] == Approx(grounds[1]));
    CHECK(lengths[0] / lengths[1] == Approx(before / after).epsilon(2e-3));
    const Image image = rasterize(drawing);
    CHECK(pixels_of(image, palette::input) > 5000);
    CHECK(pixels_of(image, palette::output) > 5000);
  }
}

TEST_CASE("pictures of improvements refuse what cannot be compared") {
  ImprovedShape shapes = cups();
  StacksPictureOptions options;
  for (const int copies : {0, -1, 201}) {
    options.copies = copies;
    CHECK_THROWS_AS(stacks_picture(shapes, options), UsageError);
  }
  options.copies = 1;
  CHECK(says(stacks_picture(shapes, options), "1 copy"));
  shapes.after.measured.direction = Eigen::Vector3d::UnitX();
  CHECK_THROWS_AS(stacks_picture(shapes, options), UsageError);
  CHECK_THROWS_AS(improvement_picture(shapes), UsageError);
}
