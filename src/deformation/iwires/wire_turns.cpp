#include "deformation/iwires/wire_turns.h"

#include <Eigen/Geometry>
#include <optional>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

class TurnSpreader {
 public:
  explicit TurnSpreader(const WireNetwork& network)
      : structure_(network.structure), network_(network), turn_(structure_.wires.size()) {}

  std::vector<Eigen::Matrix3d> spread(int edited, const Eigen::Matrix3d& linear) {
    for (const WireImage& image : images_of(structure_, edited))
      at(image.wire) = image.linear * linear * image.linear.transpose();
    to_parallel();
    to_planes();
    std::vector<Eigen::Matrix3d> turns;
    for (const auto& turn : turn_) turns.push_back(turn.value_or(Eigen::Matrix3d::Identity()));
    return turns;
  }

 private:
  std::optional<Eigen::Matrix3d>& at(int wire) { return turn_[static_cast<std::size_t>(wire)]; }
  const Wire& wire(int k) const { return structure_.wires[static_cast<std::size_t>(k)]; }

  bool agree(const std::vector<int>& sources) {
    for (const int k : sources)
      if ((*at(k) - *at(sources.front())).cwiseAbs().maxCoeff() > tolerance::relative) return false;
    return true;
  }

  /// Returns the turn of the source nearest to wire k; nothing when sources of different turns are equally
  /// near.
  std::optional<Eigen::Matrix3d> nearest(int k, const std::vector<int>& sources) {
    std::vector<int> best;
    double least = 0;
    for (const int source : sources) {
      const double distance = (wire(source).centre - wire(k).centre).norm();
      const double slack = tolerance::relative * network_.diagonal;
      if (best.empty() || distance < least - slack) {
        best = {source};
        least = distance;
      } else if (distance <= least + slack) {
        best.push_back(source);
      }
    }
    return agree(best) ? at(best.front()) : std::nullopt;
  }

  void to_parallel() {
    for (const auto& parallel : structure_.parallel) {
      std::vector<int> sources;
      for (const int k : parallel)
        if (at(k)) sources.push_back(k);
      if (sources.empty()) continue;
      const bool all = agree(sources);
      for (const int k : parallel)
        if (!at(k)) at(k) = all ? at(sources.front()) : nearest(k, sources);
    }
  }

  void to_planes() {
    for (const WirePlane& plane : structure_.planes) {
      std::optional<Eigen::Matrix3d> turn;
      for (const int k : plane.wires)
        if (!turn && wire(k).form != WireForm::straight) turn = at(k);
      for (const int k : plane.wires)
        if (turn && !at(k) && wire(k).form != WireForm::straight) at(k) = turn;
    }
  }

  const WireStructure& structure_;
  const WireNetwork& network_;
  std::vector<std::optional<Eigen::Matrix3d>> turn_;
};

}  // namespace

std::vector<Eigen::Matrix3d> spread_turn(const WireNetwork& network, int edited,
                                         const Eigen::Matrix3d& linear) {
  return TurnSpreader(network).spread(edited, linear);
}

}  // namespace stackabilization::detail
