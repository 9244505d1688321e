#include <Eigen/Geometry>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/scene.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

int pixels_where(const Image& image, bool (*wanted)(int, int, int)) {
  int count = 0;
  for (std::size_t i = 0; i < image.bytes.size(); i += 3)
    count += wanted(image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]) ? 1 : 0;
  return count;
}

bool is_ink(int red, int green, int blue) {
  return red + green + blue < 3 * 250;
}
bool is_red(int red, int green, int blue) {
  return red > 120 && green < 70 && blue < 70;
}
bool is_blue(int red, int green, int blue) {
  return blue > red + 40 && green > red;
}
bool is_yellow(int red, int green, int blue) {
  return red > blue + 60 && green > blue + 40;
}

ViewOptions small_view() {
  ViewOptions options;
  options.width = 200;
  options.height = 150;
  return options;
}

/// A red square of side 1 on the top of the unit box, or a single point there.
std::vector<ContactRegion> contact_on_top(double side) {
  ContactPolygon piece{0, 0, Points(4, 3), Points(4, 3)};
  const double a = 0.5 - side / 2, b = 0.5 + side / 2;
  piece.upper_points << a, a, 1, b, a, 1, b, b, 1, a, b, 1;
  piece.lower_points = piece.upper_points;
  ContactRegion region;
  region.upper_centre = region.lower_centre = {0.5, 0.5, 1};
  region.long_axis = {1, 0, 0};
  region.polygons = {piece};
  return {region};
}

}  // namespace

TEST_CASE("a view is orthonormal, upright and at the asked elevation") {
  for (const Direction& up :
       {Direction(0, 0, 1), Direction(0.3, -0.2, 1), Direction(0, 1, 0), Direction(0, 0, -1)}) {
    const View view = turned_view(up, small_view());
    Eigen::Matrix3d axes;
    axes << view.right, view.up, view.towards;
    CHECK((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    CHECK(axes.determinant() == Approx(1));
    CHECK(view.right.dot(up.unit()) == Approx(0).margin(1e-12));
    CHECK(view.towards.dot(up.unit()) == Approx(std::sin(25 * std::acos(-1.0) / 180)));
  }
}

TEST_CASE("a fitted view shows everything and leaves the margin on its tighter side") {
  Scene scene;
  scene.add({solids::box({2, 7, 4}), {palette::input}});
  const ViewOptions options = small_view();
  const View view = fit_view(scene, Direction(0, 0, 1), options);
  Eigen::Array2d low(1e9, 1e9), high = -low;
  for (const auto& vertex : scene.meshes[0].shape.vertices.rowwise()) {
    low = low.min(view.project(vertex.transpose()).array());
    high = high.max(view.project(vertex.transpose()).array());
  }
  const double border = options.margin * 150;
  CHECK(low.minCoeff() == Approx(border));
  CHECK(low[0] == Approx(200 - high[0]));
  CHECK(low[1] == Approx(150 - high[1]));
  CHECK(low[0] >= border * 0.999);
}

TEST_CASE("a box covers the area of its silhouette, in its own colour, on white ground") {
  Scene scene;
  scene.add({solids::box({2, 3, 4}), {palette::input}});
  const View view = fit_view(scene, Direction(0, 0, 1), small_view());
  const Image image = render(scene, view, 2);
  CHECK(image.width == 400);
  CHECK(image.height == 300);
  const Eigen::Vector3d d = view.towards.cwiseAbs();
  const double silhouette = d.x() * 3 * 4 + d.y() * 2 * 4 + d.z() * 2 * 3;
  CHECK(pixels_where(image, is_ink) ==
        Approx(silhouette * std::pow(2 * view.pixels_per_unit, 2)).epsilon(0.04));
  CHECK(pixels_where(image, is_yellow) > 0.9 * pixels_where(image, is_ink));
  CHECK(image.pixel(0, 0) == std::array<std::uint8_t, 3>{255, 255, 255});
  CHECK(image.bytes == render(scene, view, 2).bytes);
}

TEST_CASE("far from the origin and tiny, a shape looks the same") {
  const auto picture = [](const Eigen::Vector3d& shift, double scale) {
    Scene scene;
    scene.add(
        {transformed(solids::box({2, 3, 4}), scale * Eigen::Matrix3d::Identity(), shift), {palette::input}});
    return pixels_where(render(scene, fit_view(scene, Direction(0, 0, 1), small_view())), is_ink);
  };
  const int expected = picture({0, 0, 0}, 1);
  CHECK(picture({1e6, -2e6, 5e5}, 1) == Approx(expected).epsilon(0.01));
  CHECK(picture({0, 0, 0}, 1e-6) == Approx(expected).epsilon(0.01));
}

TEST_CASE("what is nearer hides what is farther") {
  Scene scene;
  const Direction up(0, 0, 1);
  const View view = turned_view(up, small_view());
  scene.add({solids::box({1, 1, 1}), {palette::input}});
  scene.add({solids::moved(solids::box({1, 1, 1}), 5 * view.towards), {palette::upper}});
  const Image image = render(scene, fit_view(scene, up, small_view()));
  CHECK(pixels_where(image, is_blue) > 1000);
  CHECK(pixels_where(image, is_yellow) < 50);
}

TEST_CASE("contacts are red on the surface, and visible even as points") {
  Scene scene;
  scene.add({solids::box({1, 1, 1}), {palette::input}});
  const View view = fit_view(scene, Direction(0, 0, 1), small_view());
  CHECK(pixels_where(render(scene, view), is_red) == 0);
  Scene wide = scene, point = scene;
  wide.add(contact_marks(contact_on_top(0.5), EnvelopeSide::upper, {0, 0, 0.004}));
  point.add(contact_marks(contact_on_top(1e-9), EnvelopeSide::upper, {0, 0, 0.004}));
  const double square = 0.25 * view.towards.z() * std::pow(2 * view.pixels_per_unit, 2);
  CHECK(pixels_where(render(wide, view), is_red) > 0.97 * square);
  CHECK(pixels_where(render(wide, view), is_red) < 1.3 * square);  // the outline is three pixels wide
  CHECK(pixels_where(render(point, view), is_red) >= 100);
  CHECK(contact_marks({}, EnvelopeSide::upper, {0, 0, 0}).meshes.empty());
}

TEST_CASE("contacts without area are drawn as lines and dots") {
  std::vector<ContactRegion> contacts = contact_on_top(0.5);
  ContactPolygon& piece = contacts[0].polygons[0];
  piece.upper_points = piece.lower_points = (Points(2, 3) << 0.2, 0.5, 1, 0.8, 0.5, 1).finished();
  const Scene marks = contact_marks(contacts, EnvelopeSide::upper, {0, 0, 0.004});
  CHECK(marks.meshes.empty());
  REQUIRE(marks.lines.size() == 2);
  CHECK(marks.lines[0].polylines.size() == 1);
}

TEST_CASE("parts take their colours in turn") {
  Scene scene;
  scene.add({concatenate(solids::box({1, 1, 1}), solids::box({2, 0, 0}, {3, 1, 1})),
             {palette::input, palette::upper}});
  const Image image = render(scene, fit_view(scene, Direction(0, 0, 1), small_view()));
  CHECK(pixels_where(image, is_yellow) > 2000);
  CHECK(pixels_where(image, is_blue) > 2000);
}

TEST_CASE("a scene refuses to be empty or colourless") {
  CHECK_THROWS_AS(fit_view(Scene{}, Direction(0, 0, 1)), UsageError);
  Scene scene;
  scene.add({solids::box({1, 1, 1}), {}});
  CHECK_THROWS_AS(render(scene, fit_view(scene, Direction(0, 0, 1), small_view())), UsageError);
}
