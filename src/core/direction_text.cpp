#include "stackabilization/core/direction_text.h"

#include <charconv>
#include <cmath>

namespace stackabilization {

std::string direction_text(const Eigen::Vector3d& direction) {
  constexpr int min_digits = 3, max_digits = 7;
  const Eigen::Vector3d unit = direction.normalized();
  Eigen::Index axis = 0;
  unit.cwiseAbs().maxCoeff(&axis);
  const auto off_axis = [axis](Eigen::Vector3d v) {
    v[axis] = 0;
    return v.cwiseAbs().maxCoeff();
  };
  if (off_axis(unit) <= std::pow(10, 1 - max_digits))
    return std::string("along ") + (unit[axis] < 0 ? "-" : "") + "xyz"[axis];
  Eigen::Vector3d shown;
  for (int digits = min_digits; digits <= max_digits; ++digits) {
    const double scale = std::pow(10, digits);
    shown = (unit * scale).array().round() / scale + 0.0;  // no -0
    if (off_axis(shown) > 0) break;
  }
  std::string text = "along (";
  for (const double component : shown) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, component, std::chars_format::fixed).ptr;
    text.append(text.back() == '(' ? "" : ", ").append(buffer, end);
  }
  return text + ")";
}

}  // namespace stackabilization
