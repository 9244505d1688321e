#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/values.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "stackabilization/io/write.h"

namespace stackabilization::python {

namespace {

using Names = std::vector<std::string>;

Unit unit_named(const std::optional<std::string>& symbol) {
  if (!symbol) return Unit::unknown;
  const std::optional<Unit> unit = apps::unit_of_symbol(*symbol);
  if (!unit) throw UsageError("unit expects one of um, mm, cm, m, in, ft, found '" + *symbol + "'");
  return *unit;
}

/// Names, none of which is one text cut into letters. Throws InputError.
Names names_of(const py::object& values) {
  if (values.is_none()) return {"part"};
  Names names;
  if (!py::isinstance<py::str>(values) && py::isinstance<py::iterable>(values))
    for (const py::handle name : values) {
      if (!py::isinstance<py::str>(name))
        throw InputError("parts expects names, found " + std::string(py::repr(name)));
      if (PyUnicode_AsUTF8(name.ptr()) == nullptr) {
        PyErr_Clear();
        throw InputError("the part name " + std::string(py::repr(name)) + " is not UTF-8");
      }
      names.push_back(name.cast<std::string>());
    }
  else
    throw InputError("parts expects a list of names, found " + std::string(py::repr(values)));
  return names;
}

std::shared_ptr<Shape> mesh_of(const py::object& vertices, const py::object& faces, const py::object& parts,
                               const py::object& face_parts, const std::optional<std::string>& unit) {
  auto shape = std::make_shared<Shape>();
  shape->vertices = as_points(rows_of_doubles(vertices, "vertices"));
  shape->triangles = triangles_of(faces);
  shape->unit = unit_named(unit);
  shape->part_names = names_of(parts);
  if (face_parts.is_none())
    shape->triangle_part.assign(static_cast<std::size_t>(shape->triangle_count()), 0);
  else
    shape->triangle_part = whole_numbers(face_parts, "face_parts");
  validate(*shape);
  return shape;
}

std::string repr(const Shape& shape) {
  std::string text = "<Mesh: " + std::to_string(shape.vertex_count()) + " vertices, " +
                     std::to_string(shape.triangle_count()) + " faces, " +
                     std::to_string(shape.part_count()) + (shape.part_count() == 1 ? " part" : " parts");
  const std::string unit = unit_symbol(shape.unit);
  return text + (unit.empty() ? "" : ", " + unit) + ">";
}

/// The shape behind a Python object of class Mesh.
const Shape& shape_in(const py::object& self) {
  return *self.cast<std::shared_ptr<Shape>>();
}

}  // namespace

void add_mesh(py::module_& module) {
  using namespace py::literals;
  py::class_<Shape, std::shared_ptr<Shape>>(
      module, "Mesh",
      "Triangles with named parts, in memory; nothing about it can be changed.\n\n"
      "It holds a copy of the arrays that it is made of. Everything afterwards shares that copy:\n"
      "`vertices` and `faces` are read-only views of it. Faces and vertices are never merged, dropped\n"
      "or reordered, so rows in results are rows of the arrays given.")
      .def(py::init(&mesh_of), "vertices"_a, "faces"_a, py::kw_only(), "parts"_a = py::none(),
           "face_parts"_a = py::none(), "unit"_a = py::none(),
           "vertices: (n, 3) finite numbers, model units; faces: (m, 3) whole numbers, rows of vertices;\n"
           "parts: k names (default: 'part'); face_parts: (m,) rows of parts (default: all 0);\n"
           "unit: 'um', 'mm', 'cm', 'm', 'in' or 'ft' (default: unknown).\n"
           "Raises InputError naming the first row that is wrong.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const Shape& shape = shape_in(self);
            return view_of(shape.vertices.data(), {shape.vertices.rows(), 3}, self);
          },
          "(n, 3) float64, model units; a read-only view, no copy.")
      .def_property_readonly(
          "faces",
          [](const py::object& self) {
            const Shape& shape = shape_in(self);
            return view_of(shape.triangles.data(), {shape.triangles.rows(), 3}, self);
          },
          "(m, 3) int32, rows of `vertices`; a read-only view, no copy.")
      .def_property_readonly(
          "face_parts",
          [](const py::object& self) {
            const Shape& shape = shape_in(self);
            return view_of(shape.triangle_part.data(), {shape.triangles.rows()}, self);
          },
          "(m,) int32, rows of `parts`; a read-only view, no copy.")
      .def_property_readonly(
          "parts", [](const Shape& shape) { return py::tuple(py::cast(shape.part_names)); },
          "Names of the parts, in the order of the file.")
      .def_property_readonly(
          "unit",
          [](const Shape& shape) {
            const std::string symbol = unit_symbol(shape.unit);
            return symbol.empty() ? py::object(py::none()) : py::object(py::str(symbol));
          },
          "'mm', 'cm', 'm', 'in', 'ft' or 'um'; None where it is unknown.")
      .def(
          "save",
          [](const Shape& shape, const std::filesystem::path& path) {
            const py::gil_scoped_release unlocked;
            write_shape(shape, path);
          },
          "path"_a,
          "Writes the mesh, whole or not at all, in the format of the extension: .obj, .off, .ply, .stl, "
          ".3mf,\n"
          ".glb, .gltf or .vtp. Raises InputError for another extension, OutputError when it cannot be "
          "written.")
      .def(py::pickle(
          [](const py::object& self) {
            const py::dict all =
                py::dict("parts"_a = self.attr("parts"), "face_parts"_a = self.attr("face_parts"),
                         "unit"_a = self.attr("unit"));
            return py::make_tuple(self.attr("vertices"), self.attr("faces"), all);
          },
          [](const py::tuple& state) {
            const py::dict all = state[2];
            std::optional<std::string> unit;
            if (!all["unit"].is_none()) unit = all["unit"].cast<std::string>();
            return mesh_of(state[0], state[1], all["parts"], all["face_parts"], unit);
          }))
      .def("__repr__", &repr);
}

}  // namespace stackabilization::python
