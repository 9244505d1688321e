#include "stackabilization/deformation/edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

constexpr int readable_digits = 5;
/// Powers of ten of the numbers that are written without an exponent.
constexpr int min_plain_exponent = -4, max_plain_exponent = 6;

constexpr std::array<const char*, 6> face_names = {"-x", "+x", "-y", "+y", "-z", "+z"};

int power_of_ten(double value) {
  return static_cast<int>(std::floor(std::log10(value)));
}

/// Writes `value` to the decimal places that give `size` five digits. Values below half of the last place
/// read 0.
std::string text(double value, double size) {
  if (!std::isfinite(size)) return significant_text(value, readable_digits);
  if (size == 0) return "0";
  const int power = power_of_ten(size), places = readable_digits - 1 - power;
  if (std::abs(value) <= std::pow(10.0, -places) / 2) return "0";
  if (power < min_plain_exponent || power > max_plain_exponent)
    return significant_text(value, std::max(1, places + 1 + power_of_ten(std::abs(value))));
  std::string digits = fixed_text(value, std::max(0, places));
  if (places > 0) digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::string text(double value) {
  return text(value, std::abs(value));
}

std::string text(const Eigen::Vector3d& v) {
  const double size = v.cwiseAbs().maxCoeff();
  std::string out = "(";
  for (int k = 0; k < 3; ++k) out += (k > 0 ? ", " : "") + text(v(k), size);
  return out += ')';
}

std::string name_of(const Handle& handle, const std::vector<std::string>& part_names) {
  const std::string number = std::to_string(handle.index);
  const auto of_part = [&] { return " of " + part_names.at(static_cast<std::size_t>(handle.part)); };
  switch (handle.kind) {
    case HandleKind::part:
      return part_names.at(static_cast<std::size_t>(handle.part));
    case HandleKind::face:
      return std::string("face ") + face_names.at(static_cast<std::size_t>(handle.index)) + of_part();
    case HandleKind::corner:
      return "corner " + number + of_part();
    case HandleKind::section:
      return "cross-section " + number + of_part();
    case HandleKind::point:
      return "point " + number;
    case HandleKind::wire:
      return "wire " + number;
    case HandleKind::shape:
      return "the shape";
  }
  return {};
}

void check_axis(const Eigen::Vector3d& axis, const std::string& of) {
  if (axis.isZero(0)) throw UsageError(of + " needs an axis that is not zero");
  try {
    static_cast<void>(Direction(axis));
  } catch (const UsageError& error) {
    throw UsageError(of + " needs an axis of another size: " + error.what() + ", found " + text(axis));
  }
}

void check_number(bool holds, const std::string& expected, double found) {
  if (!holds) throw UsageError(expected + ", found " + text(found));
}

void check(const Rotate& rotate) {
  check_axis(rotate.axis, "a rotation");
  const double degrees = rotate.radians * 180 / std::numbers::pi;
  // The angle was typed in degrees and converted to radians: allow for rounding.
  check_number(std::abs(degrees) <= edit_limits::max_degrees * (1 + tolerance::relative),
               "a rotation needs an angle from -" + text(edit_limits::max_degrees) + " to " +
                   text(edit_limits::max_degrees) + " degrees",
               degrees);
}

void check(const Scale& scale) {
  check_number(scale.factor > 0, "a scaling needs a positive factor", scale.factor);
  check_number(scale.factor >= 1 / edit_limits::max_scale && scale.factor <= edit_limits::max_scale,
               "a scaling needs a factor from " + text(1 / edit_limits::max_scale) + " to " +
                   text(edit_limits::max_scale),
               scale.factor);
  if (scale.along) check_axis(*scale.along, "a scaling along an axis");
}

void check(const Taper& taper) {
  check_number(taper.factor > 0, "a taper needs a positive factor", taper.factor);
  check_number(taper.factor >= 1 / edit_limits::max_scale && taper.factor <= edit_limits::max_scale,
               "a taper needs a factor from " + text(1 / edit_limits::max_scale) + " to " +
                   text(edit_limits::max_scale),
               taper.factor);
  check_axis(taper.axis, "a taper");
  if (!taper.along) return;
  check_axis(*taper.along, "a taper along one direction");
  const double cosine = taper.along->normalized().dot(taper.axis.normalized());
  check_number(std::abs(cosine) <= tolerance::relative, "a taper needs a direction across its axis", cosine);
}

void check(const Lean& lean) {
  if (!lean.by.allFinite()) throw UsageError("a leaning needs a finite translation, found " + text(lean.by));
  check_axis(lean.axis, "a leaning");
  if (lean.by.isZero(0)) return;
  const double cosine = lean.by.stableNormalized().dot(lean.axis.normalized());
  check_number(std::abs(cosine) <= tolerance::relative, "a leaning needs a translation across its axis",
               cosine);
}

}  // namespace

const std::vector<std::string>& handle_kind_names() {
  static const std::vector<std::string> names = {"part",  "face", "corner", "section",
                                                 "point", "wire", "shape"};
  return names;
}

void validate(const Edit& edit) {
  if (const auto* move = std::get_if<Move>(&edit.operation)) {
    if (!move->by.allFinite()) throw UsageError("a move needs a finite translation, found " + text(move->by));
  } else if (const auto* rotate = std::get_if<Rotate>(&edit.operation)) {
    check(*rotate);
  } else if (const auto* taper = std::get_if<Taper>(&edit.operation)) {
    if (edit.handle.kind != HandleKind::shape) throw UsageError("only the shape can be tapered");
    check(*taper);
  } else if (const auto* lean = std::get_if<Lean>(&edit.operation)) {
    if (edit.handle.kind != HandleKind::part) throw UsageError("only parts can lean");
    check(*lean);
  } else {
    check(std::get<Scale>(edit.operation));
  }
}

void validate(const Edit& edit, double diagonal) {
  validate(edit);
  const auto* move = std::get_if<Move>(&edit.operation);
  const auto* lean = std::get_if<Lean>(&edit.operation);
  if (move == nullptr && lean == nullptr) return;
  const Eigen::Vector3d& by = move ? move->by : lean->by;
  const double most = edit_limits::max_move * diagonal;
  if (!(by.stableNorm() <= most))
    throw UsageError(std::string(move ? "a move" : "a leaning") + " goes at most " +
                     text(edit_limits::max_move) + " times the diagonal of the shape, that is " + text(most) +
                     ", found " + text(by));
}

void validate(const DeformationConstraints& constraints, const Shape& rest) {
  for (const int part : constraints.fixed_parts)
    if (part < 0 || part >= rest.part_count())
      throw UsageError("the fixed part " + std::to_string(part) + " does not exist");
  if (const auto& allowed = constraints.box_tolerance)
    check_number(std::isfinite(*allowed) && *allowed >= 0,
                 "the tolerance of the box needs a finite number that is not negative", *allowed);
  if (constraints.fixed_points.empty()) return;
  Eigen::Vector3d low, high;
  for (int a = 0; a < 3; ++a) {
    const Range range = range_along(rest, Eigen::Vector3d::Unit(a));
    low(a) = range.low, high(a) = range.high;
  }
  const double most = edit_limits::max_fixed_distance * (high - low).norm();
  for (const Eigen::Vector3d& point : constraints.fixed_points) {
    const Eigen::Vector3d outside = point - point.cwiseMax(low).cwiseMin(high);
    if (!point.allFinite() || !(outside.stableNorm() <= most))
      throw UsageError("a fixed point lies on the surface, or at most " + text(most) +
                       " outside of its bounding box, found " + text(point));
  }
}

bool falls_off_linearly(const Edit& edit) {
  return edit.falloff == Falloff::linear && edit.handle.kind == HandleKind::section &&
         (std::holds_alternative<Move>(edit.operation) || std::holds_alternative<Scale>(edit.operation));
}

std::string describe(const Edit& edit, const std::vector<std::string>& part_names) {
  const std::string name = name_of(edit.handle, part_names);
  const std::string how = falls_off_linearly(edit) ? ", linearly" : "";
  if (const auto* move = std::get_if<Move>(&edit.operation))
    return "move " + name + " by " + text(move->by) + how;
  if (const auto* rotate = std::get_if<Rotate>(&edit.operation))
    return "rotate " + name + " by " + text(rotate->radians * 180 / std::numbers::pi) + " degrees about " +
           text(rotate->axis);
  if (const auto* taper = std::get_if<Taper>(&edit.operation))
    return "taper " + name + " by " + text(taper->factor) + " towards " + text(taper->axis) +
           (taper->along ? " along " + text(*taper->along) : "");
  if (const auto* lean = std::get_if<Lean>(&edit.operation))
    return "lean " + name + " by " + text(lean->by) + " towards " + text(lean->axis);
  const Scale& scale = std::get<Scale>(edit.operation);
  return "scale " + name + " by " + text(scale.factor) + (scale.along ? " along " + text(*scale.along) : "") +
         how;
}

}  // namespace stackabilization
