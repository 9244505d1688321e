#include <Eigen/Geometry>
#include <cmath>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/pictures.h"
#include "support/catch.h"
#include "support/picture_checks.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

TEST_CASE("the sheet of a measurement shows the shape, both envelopes, the contacts and the numbers") {
  const Shape cup = solids::frustum_shell({});
  const Direction up(0, 0, 1);
  const StackabilitySolver solver(cup);
  const Stackability measured = solver.measure(up);
  const std::vector<ContactRegion> contacts =
      contact_regions({cup, solver.tree(), up, solver.separation(up)}).regions;
  const PictureOptions options{800, 590, "cup.obj"};
  const Drawing sheet = measure_picture(cup, measured, contacts, options);
  check_nothing_clipped(sheet);
  CHECK(says(sheet, "cup.obj"));
  CHECK(says(sheet, "h = 8"));
  CHECK(says(sheet, "f_max = 4.25"));
  CHECK(says(sheet, "(0, 0, 1)"));
  const Image image = rasterize(sheet);
  CHECK(image.width == 800);
  CHECK(image.height == 590);
  CHECK(distinct_colours(image) > 1000);
  for (const Colour& colour : {palette::input, palette::upper, palette::lower, palette::contact})
    CHECK(pixels_of(image, colour) > 100);
  CHECK(png_bytes(image) == png_bytes(rasterize(measure_picture(cup, measured, contacts, options))));
}

TEST_CASE("a sheet finds room for long names, flat shapes and slanted directions") {
  const Shape slab = solids::box({9, 4, 0.05});
  const Stackability measured = stackability(slab, Direction(0.2, 0.1, 1));
  check_nothing_clipped(measure_picture(slab, measured, {}, {700, 520, std::string(200, 'W') + ".obj"}));
}

TEST_CASE("a sheet comes for shapes whose envelopes are flat or cannot be seen, and says so") {
  const Shape box = solids::box({1, 1, 1});  // bottom, top, walls
  Shape walls = box, bin = box;
  const Direction up(0, 0, 1);
  std::vector<Eigen::Index> upright, low;
  for (Eigen::Index t = 0; t < box.triangle_count(); ++t) {
    const double normal =
        (box.corner(t, 1) - box.corner(t, 0)).cross(box.corner(t, 2) - box.corner(t, 0)).z();
    if (normal == 0) upright.push_back(t);
    if (normal <= 0) low.push_back(t);
  }
  walls.triangles = box.triangles(upright, Eigen::all).eval();
  walls.triangle_part.resize(upright.size());
  bin.triangles = box.triangles(low, Eigen::all).eval();
  bin.triangle_part.resize(low.size());
  for (const Shape& shape : {walls, bin}) {
    StackabilityOptions stackability;
    stackability.semantics = ContactSemantics::closed;
    const StackabilitySolver solver(shape, stackability);
    ContactOptions band;
    band.semantics = ContactSemantics::closed;
    const Drawing sheet = measure_picture(
        shape, solver.measure(up),
        contact_regions({shape, solver.tree(), up, solver.separation(up)}, band).regions, {800, 590, {}});
    check_nothing_clipped(sheet);
    CHECK(says(sheet, "No envelope to show") == (shape.triangle_count() == 8));
  }
}

TEST_CASE("a stack shows every copy in its shade and states the total height") {
  const Shape cup = solids::frustum_shell({});
  std::vector<Shape> copies;
  for (int k = 0; k < 3; ++k) copies.push_back(solids::moved(cup, {0, 0, 4.25 * k}));
  StackPictureOptions options;
  options.width = 600;
  options.height = 450;
  options.title = "three cups";
  options.notes = {"S = 0.31"};
  const Drawing drawing = stack_picture(copies, Direction(0, 0, 1), options);
  check_nothing_clipped(drawing);
  CHECK(says(drawing, "total height 16.5"));
  CHECK(says(drawing, "three cups"));
  const Image image = rasterize(drawing);
  CHECK(pixels_of(image, palette::input) > 2000);
  CHECK(pixels_of(image, mix(palette::input, palette::white, 0.5)) > 1000);
  CHECK(png_bytes(image) == png_bytes(rasterize(stack_picture(copies, Direction(0, 0, 1), options))));
  CHECK_THROWS_AS(stack_picture({}, Direction(0, 0, 1)), UsageError);
}

TEST_CASE("a gap picture has one sharp cell per sample and names the largest value") {
  const Shape cup = solids::frustum_shell({});
  const Direction up(0, 0, 1);
  const HeightField field = height_field_by_scanline(cup, up, window_around(cup, up, 50));
  const Drawing drawing = gap_picture(field);
  check_nothing_clipped(drawing);
  const double largest = maximum_gap(field).value;
  const Eigen::MatrixXd values = gap(field);
  const Image image = rasterize(drawing);
  const auto placed =
      std::find_if(drawing.elements.begin(), drawing.elements.end(),
                   [](const DrawingElement& e) { return std::holds_alternative<PlacedImage>(e); });
  REQUIRE(placed != drawing.elements.end());
  const Rectangle place = std::get<PlacedImage>(*placed).place;
  int compared = 0;
  for (const int i : {0, 3, 7, 20, 25, 41}) {
    const int j = 25;  // off the ring that marks the maximum
    const double cell = place.width / 50;
    const auto pixel = image.pixel(static_cast<int>(place.x + (i + 0.5) * cell),
                                   static_cast<int>(place.bottom() - (j + 0.5) * cell));
    if (i == maximum_gap(field).column) continue;
    CHECK(pixel == bytes_of(std::isnan(values(i, j)) ? palette::white : viridis(values(i, j) / largest)));
    ++compared;
  }
  CHECK(compared >= 5);
}

TEST_CASE("the colour bar beside a thin image keeps its labels apart") {
  const Shape rail = solids::box({1000, 1, 1});
  const Direction up(0, 0, 1);
  const Drawing drawing = gap_picture(height_field_by_scanline(rail, up, window_around(rail, up, 400)));
  check_nothing_clipped(drawing);
  std::vector<double> levels;
  for (const DrawingElement& element : drawing.elements)
    if (const auto* text = std::get_if<Text>(&element);
        text != nullptr && text->text.find_first_not_of("0123456789.") == std::string::npos)
      levels.push_back(text->at.y());
  REQUIRE(levels.size() >= 3);
  for (std::size_t k = 1; k < levels.size(); ++k) CHECK(levels[k - 1] - levels[k] >= 20);
}

TEST_CASE("rounding does not colour a gap image") {
  const Shape box = solids::box({1, 1, 1});
  const Direction up(0, 0, 1);
  HeightField field = height_field_by_scanline(box, up, window_around(box, up, 10));
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      field.upper(i, j) = 0.1 * i;  // a sheet with steps
      field.lower(i, j) = 0.1 * i - 1e-8 * j;
    }
  for (const DrawingElement& element : gap_picture(field).elements)
    if (const auto* image = std::get_if<PlacedImage>(&element); image != nullptr && image->image.width == 10)
      for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y) CHECK(image->image.pixel(x, y) == bytes_of(viridis(0)));
  field.lower = field.upper;
  CHECK(says(gap_picture(field), "f = 0 throughout"));
  field.lower.setConstant(std::numeric_limits<double>::infinity());
  CHECK(says(gap_picture(field), "none meets the shape"));
}

TEST_CASE("contacts cover a plate however thin") {
  for (const double thickness : {1e-2, 1e-6}) {
    const Shape plate = solids::box({1, 1, thickness});
    const Direction up(0, 0, 1);
    const StackabilitySolver solver(plate);
    const Drawing sheet = measure_picture(
        plate, solver.measure(up), contact_regions({plate, solver.tree(), up, solver.separation(up)}).regions,
        {800, 590, {}});
    CHECK(pixels_of(rasterize(sheet), palette::contact) > 20000);
  }
}

TEST_CASE("the caption of a dimension stays clear of its ticks, however short") {
  for (const Anchor side : {Anchor::left, Anchor::right}) {
    const double size = 20;
    const detail::Elements elements = detail::vertical_dimension({100, 50.2, 50, "total height", side}, size);
    double first = 1e9, last = -1e9, caption = 0;
    for (const DrawingElement& element : elements) {
      if (const auto* line = std::get_if<Polyline>(&element)) {
        first = std::min(first, line->points.col(0).minCoeff());
        last = std::max(last, line->points.col(0).maxCoeff());
      }
      if (const auto* text = std::get_if<Text>(&element)) caption = text->at.x();
    }
    CHECK((caption + 0.25 * size < first || caption - 0.8 * size > last));
  }
}

TEST_CASE("a map gives every direction the colour of the nearest sample") {
  StackabilityMap map;
  for (int k = 0; k < 300; ++k) {  // spiral over the hemisphere
    const double z = 1 - (k + 0.5) / 300, angle = 2.4 * k, r = std::sqrt(1 - z * z);
    MapSample sample;
    sample.direction = {r * std::cos(angle), r * std::sin(angle), z};
    sample.stackability = std::sin(5 * sample.direction.x()) + sample.direction.y() * sample.direction.z();
    map.samples.push_back(sample);
  }
  const Drawing drawing = map_picture(map);
  check_nothing_clipped(drawing);
  const PlacedImage& disc = std::get<PlacedImage>(
      *std::find_if(drawing.elements.begin(), drawing.elements.end(),
                    [](const DrawingElement& e) { return std::holds_alternative<PlacedImage>(e); }));
  double low = 1e9, high = -1e9;
  for (const MapSample& sample : map.samples) {
    low = std::min(low, sample.stackability);
    high = std::max(high, sample.stackability);
  }
  const int pixels = disc.image.width;
  int compared = 0, equal = 0;
  for (int y = 5; y < pixels; y += 37)
    for (int x = 3; x < pixels; x += 31) {
      const Eigen::Vector2d p(2 * (x + 0.5) / pixels - 1, 1 - 2 * (y + 0.5) / pixels);
      if (p.norm() > 1) {
        CHECK(disc.image.pixel(x, y) == bytes_of(palette::white));
        continue;
      }
      // Lambert's projection: a point at distance sin(angle / 2) sqrt(2) from the centre.
      const double angle = 2 * std::asin(p.norm() / std::sqrt(2.0));
      const Eigen::Vector2d way = p.norm() > 0 ? Eigen::Vector2d(p.normalized()) : Eigen::Vector2d(1, 0);
      const Eigen::Vector3d d(std::sin(angle) * way.x(), std::sin(angle) * way.y(), std::cos(angle));
      const MapSample* nearest = &map.samples.front();
      for (const MapSample& sample : map.samples)
        if (std::abs(sample.direction.dot(d)) > std::abs(nearest->direction.dot(d))) nearest = &sample;
      ++compared;
      if (disc.image.pixel(x, y) == bytes_of(viridis((nearest->stackability - low) / (high - low)))) ++equal;
    }
  CHECK(compared > 1000);
  CHECK(equal == compared);
}

TEST_CASE("a map names its best direction and refuses what is not a map") {
  StackabilityMap map;
  CHECK_THROWS_AS(map_picture(map), UsageError);
  map.samples = {{{0, 0, 1}, 0, 0, 0, 0.25}, {{1, 0, 0}, 90, 0, 0, 0.75}};
  CHECK(says(map_picture(map), "best S = 0.7500 along x"));
  CHECK(svg_text(map_picture(map)) == svg_text(map_picture(map)));
  map.samples[1].stackability = std::nan("");
  CHECK_THROWS_AS(map_picture(map), UsageError);
}

TEST_CASE("a picture of draft shows what is undercut, what is steep and what is not") {
  const Shape seat = solids::named(solids::box({0, 0, 4}, {5, 5, 5}), "seat");
  const Shape bar = solids::named(solids::box({1, 1, 0}, {4, 4, 1}), "bar");
  const Shape stool = concatenate(seat, bar);
  const auto drawing_of = [](const Shape& shape) {
    return draft_picture(shape, analyse_draft(shape, SeparationTree(shape), {0, 0, 1}), {0, 0, 1},
                         {800, 450, 1, "stool", {"two notes"}});
  };
  const Drawing drawing = drawing_of(stool);
  check_nothing_clipped(drawing);
  for (const std::string text : {"stool", "two notes", "leaves the mould", "undercut"})
    CHECK(says(drawing, text));
  // The swatch of the legend has 200 pixels or so; the top of the bar and what is over it have more.
  const long long swatch = pixels_of(rasterize(drawing_of(bar)), palette::contact);
  CHECK(pixels_of(rasterize(drawing), palette::contact) > swatch + 500);
}

TEST_CASE("a picture of a drop has one cell per place, in the colour of its height") {
  DroppedShape dropped{solids::stairs({}), solids::box({0, 0, 3}, {1, 1, 4}), {}, {}, {0, 0, 1}};
  dropped.map = {{0, 1, 2}, {10, 11}, {0, 1, 2, 3, 4, 5}, false};
  dropped.place = {2, 10, 0};
  const Drawing drawing = drop_picture(dropped, {800, 450, "box on stairs", {"lowest point 2"}});
  check_nothing_clipped(drawing);
  CHECK(says(drawing, "box on stairs"));
  CHECK(says(drawing, "lowest point 2"));
  CHECK(says(drawing, "3 x 2 places of its centre"));
  std::vector<PlacedImage> images;
  for (const DrawingElement& element : drawing.elements)
    if (const auto* image = std::get_if<PlacedImage>(&element)) images.push_back(*image);
  const auto map = std::find_if(images.begin(), images.end(),
                                [](const PlacedImage& image) { return image.sampling == Sampling::cells; });
  REQUIRE(map != images.end());
  REQUIRE(map->image.width == 3);
  REQUIRE(map->image.height == 2);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) CHECK(map->image.pixel(i, 1 - j) == bytes_of(viridis((3 * j + i) / 5.0)));
  const Image all = rasterize(drawing);
  for (const Colour& colour : {palette::input, palette::lower, palette::contact})
    CHECK(pixels_of(all, colour) > 50);

  dropped.place.x = 7;
  CHECK(says(drop_picture(dropped), "it lies at none of them"));
  dropped.map = {{0}, {0}, {2}, false};
  CHECK(says(drop_picture(dropped), "2 high at each"));
  dropped.map.heights = {};
  CHECK_THROWS_AS(drop_picture(dropped), UsageError);
  dropped.map.heights = {std::nan("")};
  CHECK_THROWS_AS(drop_picture(dropped), UsageError);
}

TEST_CASE("numbers in pictures are short and plain") {
  CHECK(detail::number_text(0.5) == "0.5");
  CHECK(detail::number_text(1.0 / 3) == "0.3333");
  CHECK(detail::number_text(14627.3) == "14630");
  CHECK(detail::number_text(-9999999) == "-10000000");
  CHECK(detail::number_text(1.25e-9) == "1.25e-09");
  CHECK(detail::number_text(123456789) == "1.235e+08");
  CHECK(fixed_text(-1e-9, 4) == "0.0000");
  CHECK(fixed_text(0.56414, 4) == "0.5641");
  CHECK(detail::length_text(21, Unit::millimetre) == "21 mm");
  CHECK(detail::length_text(21, Unit::unknown) == "21");
  CHECK(detail::ticks(-0.2, 0.9, 6) == std::vector<double>{-0.2, 0, 0.2, 0.4, 3 * 0.2, 0.8});
  CHECK(detail::ticks(2, 2, 6) == std::vector<double>{2});
}
