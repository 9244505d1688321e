#include "rendering/pictures/map_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {
namespace {

// Beyond the rim the disc is continued with mirrored directions, so that cells at the rim are right.
constexpr double continued_radius = 1.2;

/// Lambert's equal-area projection from +z; the hemisphere z >= 0 becomes the unit disc.
Eigen::Vector2d to_disc(const Eigen::Vector3d& d) {
  return d.head<2>() / std::sqrt(1 + d.z());
}

Eigen::Vector3d from_disc(const Eigen::Vector2d& p) {
  const double squared = p.squaredNorm();
  return {p.x() * std::sqrt(std::max(0.0, 2 - squared)), p.y() * std::sqrt(std::max(0.0, 2 - squared)),
          1 - squared};
}

/// Nearest sample to a point of the disc, through square buckets of about one sample each.
class NearestSample {
 public:
  explicit NearestSample(const std::vector<MapSample>& samples);
  double value_at(const Eigen::Vector2d& point) const;

 private:
  struct Entry {
    Eigen::Vector3d direction;
    double value;
  };
  int bucket_coordinate(double x) const {
    return std::clamp(static_cast<int>((x + continued_radius) / (2 * continued_radius) * side_), 0,
                      side_ - 1);
  }
  void insert(const Eigen::Vector3d& direction, double value);

  int side_;
  std::vector<std::vector<Entry>> buckets_;
};

NearestSample::NearestSample(const std::vector<MapSample>& samples)
    : side_(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(samples.size()))))),
      buckets_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {
  for (const MapSample& sample : samples) {
    insert(sample.direction.normalized(), sample.stackability);
    insert(-sample.direction.normalized(), sample.stackability);
  }
}

void NearestSample::insert(const Eigen::Vector3d& direction, double value) {
  if (direction.z() <= -1 || to_disc(direction).norm() > continued_radius) return;
  const Eigen::Vector2d p = to_disc(direction);
  buckets_[static_cast<std::size_t>(bucket_coordinate(p.y()) * side_ + bucket_coordinate(p.x()))].push_back(
      {direction, value});
}

/// Searches growing squares of buckets, and two rings beyond the first hit: the projection stretches lengths
/// by at most sqrt(2).
double NearestSample::value_at(const Eigen::Vector2d& point) const {
  const Eigen::Vector3d direction = from_disc(point);
  const int column = bucket_coordinate(point.x()), row = bucket_coordinate(point.y());
  double best = -2, value = 0;
  int stop = side_;
  for (int ring = 0; ring <= stop; ++ring)
    for (int y = std::max(0, row - ring); y <= std::min(side_ - 1, row + ring); ++y)
      for (int x = std::max(0, column - ring); x <= std::min(side_ - 1, column + ring); ++x) {
        if (std::max(std::abs(x - column), std::abs(y - row)) != ring) continue;
        for (const Entry& entry : buckets_[static_cast<std::size_t>(y * side_ + x)])
          if (const double cosine = direction.dot(entry.direction); cosine > best) {
            best = cosine;
            value = entry.value;
            stop = std::min(stop, ring + 2 + ring / 2);
          }
      }
  return value;
}

Image disc_image(const std::vector<MapSample>& samples, const Range& range, int pixels) {
  const NearestSample nearest(samples);
  Image image(pixels, pixels, palette::white);
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const Eigen::Vector2d p(2 * (x + 0.5) / pixels - 1, 1 - 2 * (y + 0.5) / pixels);
      if (p.norm() > 1) continue;
      const double span = range.high - range.low;
      image.set_pixel(x, y, viridis(span > 0 ? (nearest.value_at(p) - range.low) / span : 1));
    }
  return image;
}

bool is_less(const MapSample& a, const MapSample& b) {
  return a.stackability < b.stackability;
}

void check(const std::vector<MapSample>& samples) {
  if (samples.empty()) throw UsageError("a map needs at least one direction");
  for (const MapSample& sample : samples)
    if (!sample.direction.allFinite() || sample.direction.isZero(0) || !std::isfinite(sample.stackability))
      throw UsageError("a map needs directions that are not zero and finite values");
}

/// Rim, circles at 30 and 60 degrees from z, and the names of the axes.
Elements graticule(const Eigen::Vector2d& centre, double radius, double size) {
  Elements elements;
  const auto append = [&](const Elements& more) {
    elements.insert(elements.end(), more.begin(), more.end());
  };
  for (const double degrees : {30.0, 60.0}) {
    const double r = std::sqrt(2.0) * std::sin(degrees / 2 * std::numbers::pi / 180);
    elements.emplace_back(Polyline{circle(centre, r * radius), palette::white, 1});
    append(outlined({{centre.x() + 0.3 * size, centre.y() - r * radius - 0.3 * size},
                     number_text(degrees) + "°",
                     0.8 * size}));
  }
  elements.emplace_back(Polyline{circle(centre, radius), palette::ink, 1.5});
  const double out = radius + 0.6 * size;
  elements.emplace_back(Text{{centre.x() + out, centre.y() + 0.35 * size}, "x", size});
  elements.emplace_back(Text{{centre.x(), centre.y() - out}, "y", size, palette::ink, Anchor::centre});
  elements.emplace_back(
      Text{{centre.x() - out, centre.y() + 0.35 * size}, "-x", size, palette::ink, Anchor::right});
  elements.emplace_back(
      Text{{centre.x(), centre.y() + out + 0.7 * size}, "-y", size, palette::ink, Anchor::centre});
  append(outlined({{centre.x() + 0.8 * size, centre.y() - 0.6 * size}, "z", 0.9 * size}));
  elements.emplace_back(
      Polyline{segment(centre.x() - 4, centre.y(), centre.x() + 4, centre.y()), palette::white, 1.5});
  elements.emplace_back(
      Polyline{segment(centre.x(), centre.y() - 4, centre.x(), centre.y() + 4), palette::white, 1.5});
  return elements;
}

}  // namespace

const MapSample& best_sample(const std::vector<MapSample>& samples) {
  check(samples);
  return *std::max_element(samples.begin(), samples.end(), is_less);
}

Elements map_panel(const Rectangle& place, const std::vector<MapSample>& samples, double text_size) {
  const MapSample& best = best_sample(samples);
  const Range range{std::min_element(samples.begin(), samples.end(), is_less)->stackability,
                    best.stackability};
  const double size = text_size, bar_room = 8.5 * size, head = 2 * size, foot = 3 * size;
  const double side = std::max(1.0, std::floor(std::min(place.width - bar_room, place.height - head - foot)));
  const Rectangle disc{place.x + 1.5 * size, place.y + head, side, side};
  Elements elements{PlacedImage{disc, disc_image(samples, range, static_cast<int>(2 * side))}};
  const auto append = [&](const Elements& more) {
    elements.insert(elements.end(), more.begin(), more.end());
  };
  const Eigen::Vector2d centre(disc.x + side / 2, disc.y + side / 2);
  append(graticule(centre, side / 2, size));
  const Eigen::Vector3d shown = (best.direction.z() < 0 ? -1.0 : 1.0) * best.direction.normalized();
  const Eigen::Vector2d at = to_disc(shown) * side / 2;
  append(ring_mark(centre + Eigen::Vector2d(at.x(), -at.y()), 0.5 * size, palette::contact));
  append(colour_bar({disc.right() + 3.2 * size, disc.y + 0.1 * side, 1.3 * size, 0.8 * side},
                    {range.low, range.high, "S"}, size));
  return elements;
}

}  // namespace stackabilization::detail
