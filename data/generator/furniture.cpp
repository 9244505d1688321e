#include <Eigen/Geometry>
#include <string>

#include "generator/modelling.h"
#include "generator/models.h"

namespace stackabilization::models {

Shape table() {
  const double length = 1.30, width = 0.78, height = 0.74, top = 0.028;
  const Eigen::Vector2d foot(0.585, 0.325);
  Assembly table;
  table.add("top",
            slab({.bottom = height - top, .top = height, .edge = 0.010},
                 rounded_rectangle(
                     {.width = length, .depth = width, .radius = 0.03, .pieces_x = 20, .pieces_y = 12})));
  for (const auto& [name, y] : {std::pair{"leg_front", -foot.y()}, std::pair{"leg_back", foot.y()}})
    table.add_pair(name, bar({.path = {{foot.x(), y, 0}, {foot.x(), y, height - 0.014}},
                              .first = {0.040, 0.040},
                              .last = {0.062, 0.062},
                              .roundness = 0.35,
                              .edge = 0.004,
                              .step = 0.08}));
  const Section board{.width = 0.022, .depth = 0.085};
  for (const auto& [name, y] : {std::pair{"apron_front", -0.330}, std::pair{"apron_back", 0.330}})
    table.add(name, bar({.path = {{-0.57, y, 0.672}, {0.57, y, 0.672}},
                         .side = Eigen::Vector3d::UnitY(),
                         .first = board,
                         .last = board,
                         .corner_points = 2,
                         .step = 0.10}));
  table.add_pair("apron", bar({.path = {{0.59, -0.31, 0.672}, {0.59, 0.31, 0.672}},
                               .side = Eigen::Vector3d::UnitX(),
                               .first = board,
                               .last = board,
                               .corner_points = 2,
                               .step = 0.10}));
  const Section rail{.width = 0.022, .depth = 0.036};
  table.add_pair("side_bar", bar({.path = {{foot.x(), -0.32, 0.15}, {foot.x(), 0.32, 0.15}},
                                  .side = Eigen::Vector3d::UnitX(),
                                  .first = rail,
                                  .last = rail,
                                  .corner_points = 2,
                                  .step = 0.08}));
  table.add("middle_bar", bar({.path = {{-0.58, 0, 0.15}, {0.58, 0, 0.15}},
                               .side = Eigen::Vector3d::UnitY(),
                               .first = rail,
                               .last = rail,
                               .corner_points = 2,
                               .step = 0.10}));
  return table.finished();
}

Shape stool() {
  const double height = 0.46;
  Assembly stool;
  stool.add("seat", lathe(profile({{0.090, height - 0.034},
                                   {0.160, height - 0.034, 0.012},
                                   {0.175, height - 0.014, 0.010},
                                   {0.170, height, 0.010},
                                   {0.090, height - 0.006}},
                                  0.035),
                          circle(56), 2));
  // A leg at height z, and a rung between the legs of two neighbouring corners.
  const auto leg_at = [](double z) { return 0.150 - 0.052 * z / 0.44; };
  const auto corner = [&](double z, int k) {
    return Eigen::Vector3d(k == 0 || k == 3 ? leg_at(z) : -leg_at(z), k < 2 ? leg_at(z) : -leg_at(z), z);
  };
  stool.add_pair("leg_back", levelled(rod(corner(-0.006, 0), corner(0.442, 0), {0.024, 0.036})));
  stool.add_pair("leg_front", levelled(rod(corner(-0.006, 3), corner(0.442, 3), {0.024, 0.036})));
  stool.add_pair("rung", rod(corner(0.16, 3), corner(0.16, 0), {0.018, 0.018}));
  stool.add("rung_front", rod(corner(0.22, 2), corner(0.22, 3), {0.018, 0.018}));
  stool.add("rung_back", rod(corner(0.22, 1), corner(0.22, 0), {0.018, 0.018}));
  return stool.finished();
}

namespace {

/// Plank between two points of the plane x = 0, the ends of its middle line, with a width at either end.
Shape plank(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector2d& widths) {
  const double length = (to - from).norm();
  const Eigen::Vector3d along = (to - from) / length, across = Eigen::Vector3d::UnitX().cross(along);
  const Outline plan = rounded_rectangle({.width = widths[0],
                                          .depth = length,
                                          .radius = 0.013,
                                          .corner_points = 3,
                                          .pieces_x = 8,
                                          .pieces_y = 10});
  return moved(slab({.bottom = -0.013, .top = 0.013, .edge = 0.006, .cap_rings = 3}, plan),
               [&](const Eigen::Vector3d& p) {
                 const double s = 0.5 + p.y() / length, taper = 1 + s * (widths[1] / widths[0] - 1);
                 return Eigen::Vector3d(from + p.x() * taper * Eigen::Vector3d::UnitX() + s * length * along +
                                        p.z() * across);
               });
}

}  // namespace

Shape zigzag_chair() {
  Assembly chair;
  chair.add("base", plank({0, -0.215, 0.013}, {0, 0.215, 0.013}, {0.37, 0.37}));
  chair.add("diagonal", plank({0, 0.208, 0.010}, {0, -0.208, 0.420}, {0.37, 0.37}));
  chair.add("seat", plank({0, -0.215, 0.417}, {0, 0.215, 0.417}, {0.37, 0.36}));
  chair.add("back", plank({0, 0.203, 0.408}, {0, 0.255, 0.74}, {0.36, 0.33}));
  return chair.finished();
}

}  // namespace stackabilization::models
