#include "stackabilization/deformation/edit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "stackabilization/shape/errors.h"

namespace stackabilization {

namespace {

constexpr int readable_digits = 5;
/// Powers of ten of what people read without exponent.
constexpr int least_plain = -4, most_plain = 6;

constexpr std::array<const char*, 6> face_names = {"-x", "+x", "-y", "+y", "-z", "+z"};

std::string chars(double value, std::chars_format format, int precision) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, precision).ptr;
  return {buffer, end};
}

int power_of_ten(double value) {
  return static_cast<int>(std::floor(std::log10(value)));
}

/// To as many places as give five digits of `size`: what is rounding beside it reads 0.
std::string text(double value, double size) {
  if (!std::isfinite(size)) return chars(value, std::chars_format::general, readable_digits);
  if (size == 0) return "0";
  const int power = power_of_ten(size), places = readable_digits - 1 - power;
  if (std::abs(value) <= std::pow(10.0, -places) / 2) return "0";
  if (power < least_plain || power > most_plain)
    return chars(value, std::chars_format::general, std::max(1, places + 1 + power_of_ten(std::abs(value))));
  std::string digits = chars(value, std::chars_format::fixed, std::max(0, places));
  if (places > 0) digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
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

bool is_axis(const Eigen::Vector3d& v) {
  return v.allFinite() && v.norm() > 0;
}

}  // namespace

void validate(const Edit& edit) {
  if (const auto* move = std::get_if<Move>(&edit.operation)) {
    if (!move->by.allFinite()) throw UsageError("a move needs a finite translation");
  } else if (const auto* rotate = std::get_if<Rotate>(&edit.operation)) {
    if (!is_axis(rotate->axis)) throw UsageError("a rotation needs a finite axis that is not zero");
    if (!std::isfinite(rotate->radians)) throw UsageError("a rotation needs a finite angle");
  } else {
    const Scale& scale = std::get<Scale>(edit.operation);
    if (!std::isfinite(scale.factor) || !(scale.factor > 0))
      throw UsageError("a scaling needs a positive factor, found " + text(scale.factor));
    if (scale.along && !is_axis(*scale.along))
      throw UsageError("a scaling along an axis needs one that is not zero");
  }
}

bool falls_off_linearly(const Edit& edit) {
  return edit.falloff == Falloff::linear && edit.handle.kind == HandleKind::section &&
         !std::holds_alternative<Rotate>(edit.operation);
}

std::string describe(const Edit& edit, const std::vector<std::string>& part_names) {
  const std::string name = name_of(edit.handle, part_names);
  const std::string how = falls_off_linearly(edit) ? ", linearly" : "";
  if (const auto* move = std::get_if<Move>(&edit.operation))
    return "move " + name + " by " + text(move->by) + how;
  if (const auto* rotate = std::get_if<Rotate>(&edit.operation))
    return "rotate " + name + " by " + text(rotate->radians * 180 / std::numbers::pi) + " degrees about " +
           text(rotate->axis);
  const Scale& scale = std::get<Scale>(edit.operation);
  return "scale " + name + " by " + text(scale.factor) + (scale.along ? " along " + text(*scale.along) : "") +
         how;
}

}  // namespace stackabilization
