#include "improvement/explanation/taper_fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace stackabilization::detail {

Eigen::Vector3d TaperMap::operator()(const Eigen::Vector3d& p) const {
  const double above = up.dot(p - from), t = above / height;
  const Eigen::Vector2d across = ((1 - t) * ends[0] + t * ends[1]) * (axes * (p - from)) + shift;
  return from + axes.transpose() * across + (stretch * above + rise) * up;
}

TaperMap fit_taper(const Points& rest, const Points& now, const Eigen::Vector3d& up, const Range& along) {
  TaperMap map;
  map.up = up;
  map.axes.row(0) = up.unitOrthogonal().transpose();
  map.axes.row(1) = up.cross(map.axes.row(0).transpose()).transpose();
  map.height = along.length();
  const Eigen::Vector3d mean = rest.colwise().mean().transpose();
  map.from = mean + (along.low - up.dot(mean)) * up;
  const Points from_rest = rest.rowwise() - map.from.transpose(),
               moved = now.rowwise() - map.from.transpose();
  const Eigen::MatrixX2d across = from_rest * map.axes.transpose();
  const Eigen::VectorXd t = from_rest * up / map.height;

  Eigen::MatrixXd sideways(rest.rows(), 5), upright(rest.rows(), 2);
  sideways << (1 - t.array()).matrix().asDiagonal() * across, t.asDiagonal() * across,
      Eigen::VectorXd::Ones(rest.rows());
  upright << t, Eigen::VectorXd::Ones(rest.rows());
  const Eigen::Matrix<double, 5, 2> found =
      sideways.colPivHouseholderQr().solve(moved * map.axes.transpose());
  const Eigen::Vector2d raised = upright.colPivHouseholderQr().solve(moved * up);
  map.ends = {found.topRows<2>().transpose(), found.middleRows<2>(2).transpose()};
  map.shift = found.row(4).transpose();
  map.stretch = raised(0) / map.height;
  map.rise = raised(1);
  return map;
}

}  // namespace stackabilization::detail
