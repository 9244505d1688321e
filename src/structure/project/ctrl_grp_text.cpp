#include "structure/project/ctrl_grp_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"

namespace stackabilization::detail {

namespace {

/// Line-by-line reader, shared by both kinds of file.
class Reader {
 public:
  Reader(const NamedText& text, const std::vector<std::string>& part_names, const CtrlGrpFrame& frame)
      : name_(text.name), cursor_({text.text, name_}), part_names_(part_names), frame_(frame) {}

  int part() {
    const std::string_view id = cursor_.token();
    if (id.empty()) cursor_.fail_expected("the name of a part", id);
    const auto found = std::find(part_names_.begin(), part_names_.end(), id);
    if (found != part_names_.end()) return static_cast<int>(found - part_names_.begin());
    if (part_names_.size() > 1 || (!only_.empty() && only_ != id))
      cursor_.fail("expected the name of a part of the shape, found " + in_quotes(id));
    only_ = id;
    return 0;
  }

  double number(const char* what) {
    const double value = cursor_.number(what);
    // In a frame of this size everything lies within 1.
    constexpr double largest = 1e6;
    if (!(std::abs(value) <= largest))
      cursor_.fail(std::string("expected ") + what + " of magnitude at most 1e6");
    return value;
  }

  Eigen::Vector3d vector(const char* what) {
    Eigen::Vector3d result;
    for (int k = 0; k < 3; ++k) result(k) = number(what);
    return result;
  }
  Eigen::Vector3d point(const char* what) { return frame_(vector(what)); }

  double not_negative(const char* what) {
    const double value = number(what);
    if (value < 0) cursor_.fail(std::string("expected ") + what + " that is not negative");
    return value;
  }
  double length(const char* what) { return frame_.scale * not_negative(what); }

  TextCursor& cursor() { return cursor_; }
  std::string place() const { return name_ + ":" + std::to_string(cursor_.line()); }

 private:
  std::string name_;
  TextCursor cursor_;
  const std::vector<std::string>& part_names_;
  CtrlGrpFrame frame_;
  std::string only_;  ///< what the files call the only part
};

Eigen::Vector3d unit_axis(Reader& reader) {
  const Eigen::Vector3d axis = reader.vector("an axis");
  constexpr double written_digits = 0.001;
  if (std::abs(axis.norm() - 1) > written_digits) reader.cursor().fail("expected an axis of length 1");
  return axis.normalized();
}

Cuboid read_cuboid(Reader& reader) {
  const Eigen::Vector3d centre = reader.point("a centre");
  Eigen::Matrix3d axes;
  for (int a = 0; a < 3; ++a) axes.col(a) = unit_axis(reader);
  Eigen::Vector3d half_extents;
  for (int a = 0; a < 3; ++a) half_extents(a) = reader.length("a half extent");
  reader.cursor().number("the flag of alignment");
  std::array<double, 6> face_scales{};  // +X -X +Y -Y +Z -Z
  for (double& scale : face_scales) scale = reader.not_negative("the scale of a face");
  Cuboid cuboid;
  for (int k = 0; k < 8; ++k) {
    Eigen::Vector3d corner;
    for (int a = 0; a < 3; ++a) corner(a) = (k >> a & 1) != 0 ? half_extents(a) : -half_extents(a);
    // A scaled face grows within its plane.
    for (int a = 0; a < 3; ++a) {
      const double scale = face_scales[static_cast<std::size_t>(2 * a + ((k >> a & 1) != 0 ? 0 : 1))];
      corner((a + 1) % 3) *= scale;
      corner((a + 2) % 3) *= scale;
    }
    cuboid.corners.row(k) = (centre + axes * corner).transpose();
  }
  return cuboid;
}

GeneralizedCylinder read_cylinder(Reader& reader) {
  for (const char* what : {"the scale of the cage", "the sides of the cage", "the step of the skeleton"})
    reader.cursor().number(what);
  const std::int64_t count = reader.cursor().integer("a number of cross-sections");
  // Four numbers each, of one byte and a blank at least.
  if (count < 2 || static_cast<std::uint64_t>(count) > reader.cursor().remaining() / 8 + 1)
    reader.cursor().fail("expected a number of cross-sections that the line has room for, found " +
                         std::to_string(count));
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(count, 3);
  cylinder.radii.resize(count);
  for (Eigen::Index k = 0; k < count; ++k)
    cylinder.centres.row(k) = reader.point("a point of the spine").transpose();
  for (Eigen::Index k = 0; k < count; ++k) cylinder.radii(k) = reader.length("a radius");
  return cylinder;
}

RelationType type_of(Reader& reader, const std::string& word) {
  if (word == "SYMMETRY") return RelationType::symmetry;
  if (word == "SELF_SYMMETRY") return RelationType::self_symmetry;
  if (word == "POINTJOINT" || word == "JOINT") return RelationType::point_joint;
  if (word == "LINEJOINT") return RelationType::line_joint;
  reader.cursor().fail("expected SYMMETRY, SELF_SYMMETRY, POINTJOINT, JOINT or LINEJOINT, found " +
                       in_quotes(word));
}

CtrlGrpRelation read_relation(Reader& reader, const std::string& word) {
  CtrlGrpRelation relation{type_of(reader, word), {}, Points(0, 3), 0, reader.place()};
  if (relation.type == RelationType::self_symmetry) {
    relation.parts = {reader.part()};
    const std::int64_t count = reader.cursor().integer("a number of self-symmetries");
    if (count < 1 || count > 3)
      reader.cursor().fail("expected one to three self-symmetries, found " + std::to_string(count));
    relation.count = static_cast<int>(count);
    return relation;
  }
  if (reader.cursor().integer("2, the number of parts") != 2) reader.cursor().fail("expected 2 parts");
  relation.parts = {reader.part(), reader.part()};
  if (relation.parts[0] == relation.parts[1]) reader.cursor().fail("expected two different parts");
  if (relation.type == RelationType::symmetry) return relation;
  relation.vectors.resize(relation.type == RelationType::line_joint ? 2 : 1, 3);
  for (auto row : relation.vectors.rowwise()) row = reader.point("a point of a joint").transpose();
  return relation;
}

/// Reads normals. They may be missing or invalid: vectors that are not unit vectors are ignored.
Points read_normals(Reader& reader, int count) {
  Points normals(count, 3);
  for (auto row : normals.rowwise())
    for (int a = 0; a < 3; ++a) {
      const std::optional<double> value = parse_number(reader.cursor().token());
      if (!value || std::abs(*value) > 1) return Points(0, 3);
      row(a) = *value;
    }
  constexpr double written_digits = 0.001;
  for (auto row : normals.rowwise()) {
    if (std::abs(row.norm() - 1) > written_digits) return Points(0, 3);
    row.normalize();
  }
  return normals;
}

}  // namespace

std::map<int, Primitive> parse_ctrl(const NamedText& controls, const std::vector<std::string>& part_names,
                                    const CtrlGrpFrame& frame) {
  std::map<int, Primitive> primitives;
  Reader reader(controls, part_names, frame);
  while (reader.cursor().next_content_line()) {
    const std::string_view word = reader.cursor().token();
    if (word != "CUBOID" && word != "GC") continue;
    const int part = reader.part();
    Primitive primitive;
    if (word == "CUBOID")
      primitive = read_cuboid(reader);
    else
      primitive = read_cylinder(reader);
    try {
      validate(primitive, part_names[static_cast<std::size_t>(part)]);
    } catch (const InputError& error) {
      reader.cursor().fail(error.what());
    }
    if (!primitives.emplace(part, std::move(primitive)).second)
      reader.cursor().fail("part '" + part_names[static_cast<std::size_t>(part)] +
                           "' has a primitive already");
  }
  return primitives;
}

std::vector<CtrlGrpRelation> parse_grp(const NamedText& groups, const std::vector<std::string>& part_names,
                                       const CtrlGrpFrame& frame) {
  std::vector<CtrlGrpRelation> relations;
  Reader reader(groups, part_names, frame);
  while (reader.cursor().next_content_line()) {
    const std::string word(reader.cursor().token());
    relations.push_back(read_relation(reader, word));
    if (relations.back().type == RelationType::self_symmetry)
      relations.back().vectors = read_normals(reader, relations.back().count);
  }
  return relations;
}

}  // namespace stackabilization::detail
