#include "stackabilization/stacking/climb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "stackabilization/shape/tolerances.h"

namespace stackabilization {

namespace {

constexpr double golden_angle = 2.399963229728653;
constexpr double golden_section = 0.6180339887498949;
constexpr double full_turn = 2 * std::numbers::pi;
constexpr int most_trials = 4000;     ///< a crest that winds on for ever ends here
constexpr int polled = 8;             ///< directions on a circle
constexpr int polled_on_crests = 12;  ///< where the best of a circle is wanted
constexpr double fine_bearing = 1e-3; ///< tolerance of a bearing along a crest, radians

class Climber {
 public:
  Climber(const StackabilitySolver& solver, const DirectionRegion& region, const Climb& start)
      : solver_(solver), region_(region), climb_(start) {
    aim();
  }

  Climb run(const ClimbOptions& options) {
    double step = options.first_step;
    int failures = 0;
    while (step > options.last_step && climb_.evaluated < most_trials) {
      if (poll(step)) {
        failures = 0;
      } else if (++failures == 2) {
        failures = 0;
        if (!options.follow_crests || !poll_crests(step)) step /= options.follow_crests ? 4 : 2;
      }
    }
    return climb_;
  }

 private:
  /// Tangent frame at the current direction; a bearing is an angle in it.
  void aim() { frame_ = frame_of(Direction(climb_.at.direction)); }

  std::optional<Eigen::Vector3d> at(double bearing, double step) const {
    const Eigen::Vector3d tangent = frame_.u * std::cos(bearing) + frame_.v * std::sin(bearing);
    return region_.nearest(frame_.w * std::cos(step) + tangent * std::sin(step));
  }

  double better() const { return climb_.at.value + tolerance::stackability; }

  /// Goes there if S is better there.
  bool go(const std::optional<Eigen::Vector3d>& direction) {
    if (!direction) return false;
    ++climb_.evaluated;
    const auto found = solver_.measure_if_above(Direction(*direction), better());
    if (!found) {
      ++climb_.abandoned;
      return false;
    }
    climb_.at = *found;
    return true;
  }

  bool go_on(double bearing, double step) {
    if (!go(at(bearing, step))) return false;
    while (step < full_turn / 16 && go(at(bearing, 2 * step))) step *= 2;
    last_bearing_ = bearing;
    aim();
    return true;
  }

  bool poll(double step);
  bool poll_crests(double step);
  bool search_bearing(double low, double high, double step);
  double value(double bearing, double step);

  const StackabilitySolver& solver_;
  const DirectionRegion& region_;
  Climb climb_;
  Frame frame_;
  double turn_ = 0, last_bearing_ = 0;
};

bool Climber::poll(double step) {
  std::vector<double> bearings = {last_bearing_};
  if (!climb_.circle_normal.isZero(0)) {
    const Eigen::Vector3d along = climb_.circle_normal.cross(frame_.w);
    const double bearing = std::atan2(along.dot(frame_.v), along.dot(frame_.u));
    bearings.insert(bearings.end(), {bearing, bearing + full_turn / 2});
  }
  turn_ += golden_angle;
  for (int k = 0; k < polled; ++k) bearings.push_back(turn_ + full_turn * k / polled);
  return std::any_of(bearings.begin(), bearings.end(), [&](double bearing) { return go_on(bearing, step); });
}

double Climber::value(double bearing, double step) {
  const auto direction = at(bearing, step);
  if (!direction) return -std::numeric_limits<double>::infinity();
  ++climb_.evaluated;
  return solver_.measure(Direction(*direction)).value;
}

bool Climber::poll_crests(double step) {
  std::array<double, polled_on_crests> values;
  for (int k = 0; k < polled_on_crests; ++k) values[k] = value(full_turn * k / polled_on_crests, step);
  std::vector<int> tops;
  for (int k = 0; k < polled_on_crests; ++k)
    if (values[k] >= values[(k + 1) % polled_on_crests] &&
        values[k] >= values[(k + polled_on_crests - 1) % polled_on_crests])
      tops.push_back(k);
  std::stable_sort(tops.begin(), tops.end(), [&](int a, int b) { return values[a] > values[b]; });
  for (std::size_t i = 0; i < std::min<std::size_t>(tops.size(), 2); ++i)
    if (search_bearing(full_turn * (tops[i] - 1) / polled_on_crests, full_turn * (tops[i] + 1) / polled_on_crests, step))
      return true;
  return false;
}

bool Climber::search_bearing(double low, double high, double step) {
  double left = high - (high - low) * golden_section, right = low + (high - low) * golden_section;
  double at_left = value(left, step), at_right = value(right, step);
  while (high - low > fine_bearing) {
    if (std::max(at_left, at_right) > better()) return go_on(at_left > at_right ? left : right, step);
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - (high - low) * golden_section;
      at_left = value(left, step);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + (high - low) * golden_section;
      at_right = value(right, step);
    }
  }
  return false;
}

}  // namespace

Climb climb(const StackabilitySolver& solver, const DirectionRegion& region, const Climb& start,
            const ClimbOptions& options) {
  return Climber(solver, region, start).run(options);
}

}  // namespace stackabilization
