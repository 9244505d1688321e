#include "generator/modelling.h"
#include "generator/models.h"

namespace stackabilization::models {

namespace {

/// Handle in the plane y = 0 whose ends lie inside the wall.
Bar handle_of(const Eigen::Matrix<double, 4, 3>& control, const Section& section) {
  return {.path = bezier(control, 16),
          .side = Eigen::Vector3d::UnitY(),
          .first = section,
          .last = section,
          .roundness = 0.9,
          .edge = 0.0008,
          .corner_points = 4,
          .step = 0.02};
}

}  // namespace

Shape mug_with_handle() {
  Assembly mug;
  mug.add("body", lathe(profile({{0.008, 0.0025},
                                 {0.0255, 0.0025, 0.001},
                                 {0.0265, 0, 0.001},
                                 {0.0290, 0, 0.001},
                                 {0.0318, 0.005, 0.003},
                                 {0.0425, 0.094, 0.0015},
                                 {0.0388, 0.094, 0.0015},
                                 {0.0288, 0.0065, 0.006},
                                 {0.008, 0.006}},
                                0.012),
                        circle(48), 0));
  Eigen::Matrix<double, 4, 3> control;
  control << 0.0392, 0, 0.080, 0.082, 0, 0.088, 0.078, 0, 0.024, 0.0346, 0, 0.042;
  mug.add("handle", bar(handle_of(control, {.width = 0.012, .depth = 0.0075})));
  return mug.finished();
}

Shape cup() {
  Assembly cup;
  cup.add("body", lathe(profile({{0.008, 0.003},
                                 {0.0255, 0.003, 0.001},
                                 {0.0265, 0, 0.0008},
                                 {0.0285, 0, 0.0008},
                                 {0.0300, 0.004, 0.002},
                                 {0.0425, 0.099, 0.001},
                                 {0.0400, 0.099, 0.001},
                                 {0.0273, 0.007, 0.004},
                                 {0.008, 0.0065}},
                                0.011),
                        circle(56), 0));
  return cup.finished();
}

Shape bowl() {
  Assembly bowl;
  bowl.add("body", lathe(profile({{0.008, 0.008},
                                  {0.034, 0.008, 0.010},
                                  {0.066, 0.026, 0.022},
                                  {0.080, 0.068, 0.002},
                                  {0.0765, 0.068, 0.002},
                                  {0.0625, 0.028, 0.021},
                                  {0.032, 0.012, 0.010},
                                  {0.008, 0.012}},
                                 0.009),
                         circle(56), 0));
  bowl.add("foot",
           hoop(profile({{0.0305, 0.0095}, {0.0325, 0}, {0.0365, 0}, {0.0375, 0.0098}}, 0.006), circle(56)));
  return bowl.finished();
}

Shape pot_with_handle() {
  Assembly pot;
  pot.add("body", lathe(profile({{0.008, 0},
                                 {0.086, 0, 0.008},
                                 {0.0915, 0.092, 0.004},
                                 {0.0965, 0.098, 0.0012},
                                 {0.0945, 0.100, 0.0012},
                                 {0.0882, 0.094, 0.004},
                                 {0.0830, 0.0045, 0.008},
                                 {0.008, 0.0045}},
                                0.026),
                        circle(48), 1));
  const Section root{.width = 0.022, .depth = 0.009};
  Eigen::Matrix<double, 4, 3> control;
  control << 0.0896, 0, 0.078, 0.130, 0, 0.078, 0.160, 0, 0.097, 0.265, 0, 0.107;
  Bar handle = handle_of(control, root);
  handle.last = {.width = 0.030, .depth = 0.013};
  handle.edge = 0.001;
  pot.add("handle", bar(handle));
  return pot.finished();
}

Shape bottle() {
  Assembly bottle;
  bottle.add("body", lathe(profile({{0.008, 0.014},
                                    {0.022, 0.006, 0.010},
                                    {0.028, 0, 0.003},
                                    {0.0375, 0, 0.004},
                                    {0.0378, 0.195, 0.020},
                                    {0.0150, 0.232, 0.016},
                                    {0.0138, 0.298, 0.001},
                                    {0.0100, 0.298, 0.001},
                                    {0.0112, 0.230, 0.015},
                                    {0.0346, 0.193, 0.020},
                                    {0.0345, 0.007, 0.006},
                                    {0.022, 0.0115},
                                    {0.008, 0.019}},
                                   0.060),
                           circle(48), 0));
  bottle.add("collar",
             hoop(profile({{0.0128, 0.278}, {0.0152, 0.278}, {0.0152, 0.291, 0.001}, {0.0128, 0.291}}, 0.014),
                  circle(48)));
  return bottle.finished();
}

}  // namespace stackabilization::models
