#include <Eigen/Geometry>

#include "io/formats/zip.h"
#include "stackabilization/core/copies.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

/// Coordinates that need all 17 digits, in places that need them too.
Copies turned(int count, const Shape& shape) {
  Copies copies{{shape}, {}};
  for (int k = 0; k < count; ++k) {
    PlacedCopy copy;
    copy.name = "copy" + std::to_string(k + 1);
    copy.rotation = Eigen::AngleAxisd(0.7 * k, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    copy.translation = k * Eigen::Vector3d(0.1, -1.0 / 3, 1e-3);
    copies.placed.push_back(copy);
  }
  return copies;
}

Shape two_parts() {
  Shape shape = cube(1.0 / 3);
  shape.part_names = {"leg", "seat <&>"};
  for (std::size_t t = 6; t < 12; ++t) shape.triangle_part[t] = 1;
  return shape;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

std::string model_of(const std::string& bytes) {
  const std::string name = "test";
  return *ZipReader({bytes, name}).entry("3D/3dmodel.model");
}

}  // namespace

TEST_CASE("copies as one shape are the shape in each place, its parts named after the copy") {
  const Copies copies = turned(3, two_parts());
  const Shape all = as_one_shape(copies);
  CHECK(all.part_names == std::vector<std::string>{"copy1/leg", "copy1/seat <&>", "copy2/leg",
                                                   "copy2/seat <&>", "copy3/leg", "copy3/seat <&>"});
  for (std::size_t k = 0; k < 3; ++k) {
    const Shape moved =
        transformed(copies.shapes.front(), copies.placed[k].rotation, copies.placed[k].translation);
    CHECK(all.vertices.middleRows(static_cast<Eigen::Index>(8 * k), 8) == moved.vertices);
  }
  Copies same = copies;
  same.placed[1].name = "copy1";
  CHECK_THROWS_AS(as_one_shape(same), InputError);
}

TEST_CASE("3MF holds the meshes of copies once, and brings them back to the bit") {
  for (const Shape& shape : {cube(1.0 / 3), two_parts(), two_tetrahedra()}) {
    const Copies copies = turned(5, shape);
    const std::string bytes = shape_bytes(copies, Format::three_mf);
    const std::string model = model_of(bytes);
    CHECK(count_of(model, "<mesh>") == shape.part_names.size());
    CHECK(count_of(model, "<item ") == 5);
    CHECK(count_of(model, "<component ") == (shape.part_count() > 1 ? shape.part_names.size() : 0));
    const Shape back = read_shape(bytes, Format::three_mf, "test");
    const Shape all = as_one_shape(copies);
    CHECK(same_corners(back, all));
    CHECK(same_parts(back, all));
  }
}

TEST_CASE("copies of two shapes are one file, each mesh once") {
  Copies copies = turned(3, two_parts());
  copies.shapes.push_back(two_tetrahedra());
  PlacedCopy between;
  between.shape = 1;
  between.name = "between";
  between.translation = {0.1, 0.2, 1.0 / 3};
  copies.placed.insert(copies.placed.begin() + 1, between);
  const Shape all = as_one_shape(copies);
  CHECK(all.triangle_count() == 3 * 12 + two_tetrahedra().triangle_count());
  CHECK(all.part_names[2] == "between/" + two_tetrahedra().part_names[0]);
  const std::string bytes = shape_bytes(copies, Format::three_mf);
  CHECK(count_of(model_of(bytes), "<mesh>") == 2 + two_tetrahedra().part_names.size());
  CHECK(count_of(model_of(bytes), "<item ") == 4);
  const Shape back = read_shape(bytes, Format::three_mf, "test");
  CHECK(same_corners(back, all));
  CHECK(same_parts(back, all));
  CHECK(same_parts(read_shape(shape_bytes(copies, Format::gltf), Format::gltf, "test"), all));
}

TEST_CASE("GLB holds the meshes of copies once, and all copies are the same shape again") {
  Shape shape = two_parts();
  shape.unit = Unit::millimetre;
  const Copies copies = turned(5, shape);
  const std::string bytes = shape_bytes(copies, Format::gltf);
  CHECK(count_of(bytes, "\"POSITION\"") == 2);
  CHECK(bytes.size() < shape_bytes(as_one_shape(copies), Format::gltf).size());
  const Shape back = read_shape(bytes, Format::gltf, "test"), all = as_one_shape(copies);
  CHECK(same_parts(back, all));
  CHECK(back.unit == Unit::metre);
  const Shape first = round_trip(shape, Format::gltf);
  for (Eigen::Index t = 0; t < all.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const PlacedCopy& copy = copies.placed[static_cast<std::size_t>(t / 12)];
      const Eigen::Vector3d placed =
          copy.rotation * first.corner(t % 12, corner) + metres_per_unit(shape.unit) * copy.translation;
      CHECK((back.corner(t, corner) - placed).norm() < 1e-17);
      CHECK((back.corner(t, corner) - metres_per_unit(shape.unit) * all.corner(t, corner)).norm() < 1e-10);
    }
}

TEST_CASE("other formats hold copies as one shape, and so do these beyond what is read from placements") {
  const Copies copies = turned(4, two_parts());
  for (const Format format : {Format::obj, Format::ply, Format::vtp, Format::stl, Format::off})
    CHECK(shape_bytes(copies, format) == shape_bytes(as_one_shape(copies), format));
  Copies many = turned(1, cube());
  many.placed.resize(50001, many.placed[0]);
  for (std::size_t k = 0; k < many.placed.size(); ++k) many.placed[k].name = "copy" + std::to_string(k);
  CHECK(count_of(model_of(shape_bytes(many, Format::three_mf)), "<mesh>") == 50001);
}
