#include <cmath>
#include <numbers>

#include "generator/modelling.h"
#include "generator/models.h"

namespace stackabilization::models {

Shape bucket_with_handles() {
  Assembly bucket;
  bucket.add("body", lathe(profile({{0.008, 0.006},
                                    {0.098, 0.006, 0.002},
                                    {0.101, 0, 0.002},
                                    {0.107, 0, 0.002},
                                    {0.112, 0.008, 0.004},
                                    {0.150, 0.280, 0.0015},
                                    {0.1462, 0.280, 0.0015},
                                    {0.1082, 0.0105, 0.010},
                                    {0.008, 0.0095}},
                                   0.06),
                           circle(48), 1));
  bucket.add("rim",
             hoop(profile({{0.1475, 0.268}, {0.1555, 0.268}, {0.1575, 0.281, 0.003}, {0.1480, 0.283}}, 0.012),
                  circle(48)));
  // Each end stands square on the wall, half way into it.
  const double height = 0.238, radius = 0.1427, angle = 0.33;
  const Eigen::Vector3d end(radius * std::cos(angle), radius * std::sin(angle), height);
  const Eigen::Vector3d out(0.062 * std::cos(angle), 0.062 * std::sin(angle), 0.006);
  Eigen::Matrix<double, 4, 3> control;
  control.row(0) = end;
  control.row(1) = end + out;
  control.row(2) = control.row(1).cwiseProduct(Eigen::RowVector3d(1, -1, 1));
  control.row(3) = control.row(0).cwiseProduct(Eigen::RowVector3d(1, -1, 1));
  bucket.add_pair("handle", bar({.path = bezier(control, 16),
                                 .side = Eigen::Vector3d::UnitZ(),
                                 .first = {.width = 0.010, .depth = 0.012},
                                 .last = {.width = 0.010, .depth = 0.012},
                                 .roundness = 0.9,
                                 .edge = 0.0008}));
  return bucket.finished();
}

Shape basket() {
  const Outline plan = rounded_rectangle(
      {.width = 0.30, .depth = 0.20, .radius = 0.095, .corner_points = 7, .pieces_x = 4, .pieces_y = 1});
  Assembly basket;
  // Five woven courses outside, a smooth lining inside.
  Curve wall = {{-0.050, 0}, {-0.020, 0}, {-0.004, 0.003}};
  const int rings = 20;
  for (int i = 1; i < rings; ++i) {
    const double s = static_cast<double>(i) / rings;
    const double bulge = 0.0016 * (1 - std::cos(2 * std::numbers::pi * 5 * s)) / 2;
    wall.emplace_back(0.042 * s + bulge, 0.003 + 0.165 * s);
  }
  const Curve lining =
      profile({{0.041, 0.168, 0}, {0.034, 0.168, 0}, {-0.007, 0.009, 0.004}, {-0.050, 0.008, 0}}, 0.034);
  wall.insert(wall.end(), lining.begin(), lining.end());
  basket.add("body", lathe(wall, plan, 2));
  basket.add("rim", hoop(profile({{0.0355, 0.162},
                                  {0.0470, 0.162, 0.003},
                                  {0.0470, 0.176, 0.003},
                                  {0.0325, 0.176, 0.003},
                                  {0.0325, 0.169, 0}},
                                 0.012),
                         plan));
  Eigen::Matrix<double, 4, 3> control;
  control << 0, -0.1321, 0.145, 0, -0.197, 0.395, 0, 0.197, 0.395, 0, 0.1321, 0.145;
  basket.add("handle", bar({.path = bezier(control, 32),
                            .side = Eigen::Vector3d::UnitX(),
                            .first = {.width = 0.030, .depth = 0.004},
                            .last = {.width = 0.030, .depth = 0.004},
                            .roundness = 0.8,
                            .edge = 0.001}));
  return basket.finished();
}

namespace {

/// A hat's brim rises at the sides and dips in front and behind; its crown is pinched along the middle.
Eigen::Vector3d felted(const Eigen::Vector3d& p) {
  const double out = std::max(0.0, p.head<2>().norm() - 0.10);
  const double brim = out * (0.35 * p.x() * p.x() - 0.30 * p.y() * p.y()) / p.head<2>().squaredNorm();
  const double high = std::max(0.0, (p.z() - 0.06) / 0.06);
  const double pinch = 0.020 * high * std::exp(-p.x() * p.x() / 0.0006) * std::exp(-p.y() * p.y() / 0.006);
  return {p.x(), p.y(), p.z() + (out > 0 ? brim : 0) - pinch};
}

}  // namespace

Shape hat() {
  const Outline plan = ellipse(48, 1.22);
  const auto part = [&](Shape shape) { return shifted(moved(std::move(shape), felted), {0, 0, 0.016}); };
  Assembly hat;
  hat.add("crown", part(lathe(profile({{0.008, 0.1085},
                                       {0.052, 0.1085, 0.016},
                                       {0.0675, 0.074, 0.016},
                                       {0.0735, 0, 0},
                                       {0.0765, 0, 0},
                                       {0.0705, 0.075, 0.016},
                                       {0.054, 0.1115, 0.016},
                                       {0.008, 0.1115}},
                                      0.017),
                              plan, 0)));
  hat.add(
      "brim",
      part(hoop(profile({{0.0745, 0.0005}, {0.128, 0.0005, 0.001}, {0.128, 0.0035, 0.001}, {0.0745, 0.0035}},
                        0.018),
                plan)));
  hat.add(
      "band",
      part(hoop(profile({{0.0745, 0.003}, {0.0773, 0.003}, {0.0751, 0.030}, {0.0720, 0.030}}, 0.014), plan)));
  return hat.finished();
}

Shape crate() {
  const Outline plan = rounded_rectangle(
      {.width = 0.37, .depth = 0.27, .radius = 0.028, .corner_points = 4, .pieces_x = 8, .pieces_y = 6});
  Assembly crate;
  crate.add("body", lathe(profile({{-0.010, 0, 0},
                                   {0, 0, 0.004},
                                   {0.013, 0.160, 0.002},
                                   {0.019, 0.163, 0.002},
                                   {0.0215, 0.220, 0},
                                   {0.0180, 0.220, 0},
                                   {0.0155, 0.166, 0.002},
                                   {0.0095, 0.163, 0.002},
                                   {-0.0040, 0.0045, 0.004},
                                   {-0.014, 0.004, 0}},
                                  0.06),
                          plan, 2));
  crate.add("rim", hoop(profile({{0.0198, 0.212},
                                 {0.0290, 0.212, 0.001},
                                 {0.0290, 0.2155, 0.001},
                                 {0.0230, 0.2225, 0.0015},
                                 {0.0175, 0.2225, 0.001},
                                 {0.0175, 0.2185}},
                                0.02),
                        plan));
  Eigen::Matrix<double, 4, 3> control;
  control << 0.2038, -0.062, 0.196, 0.240, -0.062, 0.196, 0.240, 0.062, 0.196, 0.2038, 0.062, 0.196;
  crate.add_pair("grip", bar({.path = bezier(control, 16),
                              .side = Eigen::Vector3d::UnitZ(),
                              .first = {.width = 0.014, .depth = 0.010},
                              .last = {.width = 0.014, .depth = 0.010},
                              .roundness = 0.8,
                              .edge = 0.0008}));
  return crate.finished();
}

}  // namespace stackabilization::models
