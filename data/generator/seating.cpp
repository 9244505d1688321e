#include <array>
#include <cmath>
#include <numbers>

#include "generator/modelling.h"
#include "generator/models.h"

namespace stackabilization::models {

namespace {

/// Seat wider in front, slightly hollowed, front edge rolled down.
Shape saddled_seat(const Rectangle& plan, const Slab& thickness) {
  return moved(slab(thickness, rounded_rectangle(plan)), [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d q(2 * p.x() / plan.width, 2 * p.y() / plan.depth);
    const double hollow = 0.010 * std::max(0.0, 1 - q.x() * q.x()) * std::max(0.0, 1 - q.y() * q.y());
    const double roll = 0.030 * std::pow(std::max(0.0, -q.y() - 0.45), 2);
    return Eigen::Vector3d(p.x() * (1 - 0.06 * q.y()), p.y(), p.z() - hollow - roll);
  });
}

/// Slat or panel across the back between +-half_width, bent backwards by `bow` in its middle.
Bar back_slat(const Eigen::Vector3d& end, double bow, const Section& section) {
  Path path;
  for (int k = -6; k <= 6; ++k) {
    const double s = k / 6.0;
    path.emplace_back(s * end.x(), end.y() + bow * (1 - s * s), end.z());
  }
  return {.path = path,
          .side = Eigen::Vector3d(0, 0.16, 1),
          .first = section,
          .last = section,
          .roundness = 0.6,
          .edge = 0.002,
          .step = 0.08};
}

struct Frame {
  double front = 0.205, back = 0.180;  ///< Half distances between the legs.
  double depth = 0.190;                ///< Half distance between front and back legs.
  double seat = 0.445;                 ///< Height of the seat's underside.
};

/// Four legs, the back ones run on as posts of the reclined back; rails under the seat, side stretchers.
void add_frame(Assembly& chair, const Frame& frame) {
  chair.add_pair("leg_front", levelled(bar({.path = {{frame.front + 0.008, -frame.depth - 0.006, -0.004},
                                                     {frame.front, -frame.depth, frame.seat + 0.006}},
                                            .first = {0.026, 0.026},
                                            .last = {0.038, 0.038},
                                            .roundness = 0.5,
                                            .edge = 0.003,
                                            .step = 0.06})));
  Eigen::Matrix<double, 4, 3> control;
  control << frame.back, frame.depth + 0.075, -0.010, frame.back, frame.depth - 0.045, 0.36, frame.back,
      frame.depth, 0.48, frame.back - 0.008, frame.depth + 0.110, 0.86;
  chair.add_pair("leg_back", levelled(bar({.path = bezier(control, 16),
                                           .first = {0.026, 0.028},
                                           .last = {0.024, 0.022},
                                           .roundness = 0.5,
                                           .edge = 0.003,
                                           .step = 0.08})));
  const Section rail{.width = 0.018, .depth = 0.052}, stretcher{.width = 0.016, .depth = 0.024};
  const double z = frame.seat - 0.024;
  const auto across = [&](double half, double y) {
    return bar({.path = {{-half, y, z}, {half, y, z}},
                .side = Eigen::Vector3d::UnitY(),
                .first = rail,
                .last = rail,
                .step = 0.07});
  };
  chair.add("rail_front", across(frame.front, -frame.depth + 0.002));
  chair.add("rail_back", across(frame.back, frame.depth - 0.004));
  const auto along = [&](double height, const Section& section) {
    return bar({.path = {{frame.front, -frame.depth, height}, {frame.back, frame.depth, height}},
                .first = section,
                .last = section,
                .step = 0.07});
  };
  chair.add_pair("rail", along(z, rail));
  chair.add_pair("stretcher", along(0.20, stretcher));
}

}  // namespace

Shape chair() {
  const Frame frame;
  Assembly chair;
  chair.add("seat", saddled_seat({.width = 0.45, .depth = 0.43, .radius = 0.04, .pieces_x = 4, .pieces_y = 4},
                                 {.bottom = frame.seat, .top = frame.seat + 0.022, .edge = 0.006}));
  add_frame(chair, frame);
  int number = 0;
  for (const auto& [y, z] : {std::pair{0.237, 0.600}, std::pair{0.261, 0.700}, std::pair{0.291, 0.815}})
    chair.add("slat_" + std::to_string(++number),
              bar(back_slat({frame.back - 0.004, y, z}, 0.022,
                            {.width = z > 0.8 ? 0.062 : 0.040, .depth = 0.011})));
  return chair.finished();
}

Shape armchair() {
  const Frame frame{.front = 0.245, .back = 0.215, .depth = 0.200, .seat = 0.430};
  Assembly chair;
  chair.add("seat", saddled_seat({.width = 0.48, .depth = 0.46, .radius = 0.05, .pieces_x = 4, .pieces_y = 4},
                                 {.bottom = frame.seat, .top = frame.seat + 0.035, .edge = 0.010}));
  add_frame(chair, frame);
  chair.add("back",
            bar(back_slat({frame.back - 0.004, 0.275, 0.735}, 0.030, {.width = 0.20, .depth = 0.014})));
  Eigen::Matrix<double, 4, 3> control;
  control << 0.222, 0.232, 0.665, 0.262, 0.10, 0.668, 0.282, -0.08, 0.662, 0.276, -0.245, 0.650;
  chair.add_pair("armrest", bar({.path = bezier(control, 11),
                                 .first = {0.026, 0.022},
                                 .last = {0.050, 0.020},
                                 .roundness = 0.8,
                                 .edge = 0.004,
                                 .step = 0.05}));
  chair.add_pair("arm_post", bar({.path = {{0.247, -0.198, 0.415}, {0.273, -0.185, 0.655}},
                                  .first = {0.030, 0.030},
                                  .last = {0.024, 0.024},
                                  .roundness = 0.6,
                                  .edge = 0.003,
                                  .step = 0.05}));
  return chair.finished();
}

namespace {

/// Wheel that stands at (reach, y) and rolls along x.
Shape castor_wheel(double reach, double y) {
  const Shape wheel = slab({.bottom = -0.009, .top = 0.009, .edge = 0.004, .cap_rings = 0},
                           [](double offset) { return circle(12)(0.030 + offset); });
  return moved(wheel, [=](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(reach + p.x(), y - p.z(), 0.030 + p.y());
  });
}

}  // namespace

Shape swivel_chair() {
  Assembly chair;
  chair.add(
      "hub",
      lathe(profile({{0.020, 0.078}, {0.036, 0.078, 0.004}, {0.036, 0.128, 0.006}, {0.020, 0.140}}, 0.03),
            circle(16), 0));
  const double reach = 0.300;
  for (int k = 0; k < 5; ++k) {
    // One arm points to the front.
    const double degrees = -90 + 72 * k;
    const std::string number = std::string("_").append(std::to_string(k + 1));
    chair.add("arm" + number,
              turned(bar({.path = {{0.018, 0, 0.108}, {0.16, 0, 0.096}, {reach + 0.012, 0, 0.078}},
                          .side = Eigen::Vector3d::UnitY(),
                          .first = {0.046, 0.034},
                          .last = {0.030, 0.018},
                          .roundness = 0.6,
                          .edge = 0.004,
                          .step = 0.15}),
                     degrees));
    chair.add("castor" + number, turned(joined({rod({reach, 0, 0.026}, {reach, 0, 0.082}, {0.018, 0.014}, 8),
                                                castor_wheel(reach, 0.015), castor_wheel(reach, -0.015)}),
                                        degrees));
  }
  chair.add("gas_column", lathe(profile({{0.012, 0.100},
                                         {0.026, 0.100},
                                         {0.025, 0.270},
                                         {0.015, 0.274},
                                         {0.014, 0.415},
                                         {0.006, 0.415}},
                                        0.05),
                                circle(16), 0));
  chair.add("mechanism",
            slab({.bottom = 0.395, .top = 0.432, .edge = 0.006, .cap_rings = 1},
                 rounded_rectangle({.width = 0.18, .depth = 0.24, .radius = 0.03, .corner_points = 3})));
  chair.add(
      "seat",
      saddled_seat(
          {.width = 0.49, .depth = 0.47, .radius = 0.11, .corner_points = 5, .pieces_x = 3, .pieces_y = 3},
          {.bottom = 0.425, .top = 0.490, .edge = 0.024, .cap_rings = 2}));
  Eigen::Matrix<double, 4, 3> control;
  control << 0, 0.08, 0.412, 0, 0.36, 0.395, 0, 0.262, 0.52, 0, 0.280, 0.70;
  chair.add("back_bar", bar({.path = bezier(control, 8),
                             .first = {0.060, 0.016},
                             .last = {0.050, 0.014},
                             .roundness = 0.6,
                             .edge = 0.003,
                             .step = 0.15}));
  const Shape cushion = slab(
      {.bottom = -0.022, .top = 0.022, .edge = 0.018, .cap_rings = 4},
      rounded_rectangle(
          {.width = 0.43, .depth = 0.40, .radius = 0.10, .corner_points = 5, .pieces_x = 3, .pieces_y = 3}));
  chair.add("back", moved(cushion, [](const Eigen::Vector3d& p) {
              const double s = p.y() / 0.20, lumbar = 0.012 * std::exp(-3 * (s + 0.4) * (s + 0.4));
              const double wrap = 0.9 * p.x() * p.x();
              return Eigen::Vector3d(p.x() * (1 - 0.08 * s), 0.272 + 0.16 * p.y() - p.z() - wrap - lumbar,
                                     0.745 + p.y());
            }));
  return chair.finished();
}

}  // namespace stackabilization::models
