#include "stackabilization/envelope/contacts.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "stackabilization/envelope/contact_polygons.h"
#include "stackabilization/envelope/planar_union.h"
#include "stackabilization/shape/errors.h"

namespace stackabilization {
namespace {

using namespace detail;

/// Contact polygons of one pair of parts, with their outlines in the plane orthogonal to r.
struct Patch {
  ContactPolygon polygon;
  Outline outline;
};

/// What the steps of one query share.
struct Setting {
  Frame frame;
  ContactOptions options;
  double reach;  ///< polygons this near to each other, in model units, touch
};

double extent_along(const Shape& shape, const Eigen::Vector3d& unit) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) {
      const double height = unit.dot(shape.corner(t, c));
      low = std::min(low, height);
      high = std::max(high, height);
    }
  return high - low;
}

double diagonal(const Shape& shape) {
  return (shape.vertices.colwise().maxCoeff() - shape.vertices.colwise().minCoeff()).norm();
}

/// The point where the separation is attained, for contacts that have no area at all.
ContactPolygon witness_polygon(const Witness& witness) {
  ContactPolygon polygon{witness.upper_triangle, witness.lower_triangle, Points(1, 3), Points(1, 3)};
  polygon.upper_points.row(0) = witness.upper_point;
  polygon.lower_points.row(0) = witness.lower_point;
  return polygon;
}

Outline outline_of(const ContactPolygon& polygon, const Frame& frame) {
  Outline outline;
  for (Eigen::Index p = 0; p < polygon.upper_points.rows(); ++p) {
    const Eigen::Vector3d local = frame.to_local(polygon.upper_points.row(p).transpose());
    outline.push_back({local.x(), local.y()});
  }
  return outline;
}

/// Centroids of the two lifted polygons, weighted by their area seen along r; equal weights where all areas vanish.
void set_centres(ContactRegion& region, const std::vector<const Patch*>& patches) {
  region.upper_centre.setZero();
  region.lower_centre.setZero();
  double total = 0;
  for (const bool by_area : {true, false}) {
    for (const Patch* patch : patches) {
      const auto centroid = outline_centroid(patch->outline);
      const double weight = by_area ? outline_area(patch->outline) : 1;
      if (!(weight > 0)) continue;
      region.upper_centre += weight * (patch->polygon.upper_points.transpose() * centroid);
      region.lower_centre += weight * (patch->polygon.lower_points.transpose() * centroid);
      total += weight;
    }
    if (total > 0) break;
  }
  region.upper_centre /= total;
  region.lower_centre /= total;
}

/// Ring, line or dot, from the union of the outlines.
void classify(ContactRegion& region, const std::vector<Outline>& outlines, const Setting& setting) {
  region.area = union_area(outlines);
  const Elongation elongation = elongation_of(outlines);
  region.long_axis = setting.frame.u * elongation.axis.x() + setting.frame.v * elongation.axis.y();
  if (largest_hole(outlines) > setting.options.least_hole * elongation.length * elongation.width) {
    region.type = ContactType::ring;
  } else if (elongation.length > 0 && elongation.length >= setting.options.line_aspect * elongation.width) {
    region.type = ContactType::line;
  }
}

ContactRegion make_region(const std::vector<Patch>& patches, const std::vector<std::size_t>& members,
                          const Setting& setting) {
  ContactRegion region;
  std::vector<const Patch*> chosen;
  std::vector<Outline> outlines;
  for (const std::size_t member : members) {
    chosen.push_back(&patches[member]);
    outlines.push_back(patches[member].outline);
    region.polygons.push_back(patches[member].polygon);
  }
  classify(region, outlines, setting);
  set_centres(region, chosen);
  return region;
}

bool comes_first(const ContactRegion& a, const ContactRegion& b) {
  if (a.area != b.area) return a.area > b.area;
  return std::lexicographical_compare(a.upper_centre.data(), a.upper_centre.data() + 3, b.upper_centre.data(),
                                      b.upper_centre.data() + 3);
}

}  // namespace

std::vector<ContactRegion> contact_regions(const Shape& shape, const SeparationTree& tree, const Direction& direction,
                                           const Separation& separation, const ContactOptions& options) {
  if (!(options.band >= 0 && options.band <= 1)) throw UsageError("the contact band must lie between 0 and 1");
  if (!separation.blocked) return {};
  const Setting setting{frame_of(direction), options, tolerance::relative * diagonal(shape)};
  const double band = options.band * extent_along(shape, setting.frame.w) / direction.length();
  std::vector<ContactPolygon> polygons =
      contact_polygons(tree.data(), direction, options.semantics, separation.value.to_double() - band);
  if (polygons.empty()) polygons.push_back(witness_polygon(separation.witness));

  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Patch>> by_parts;
  for (ContactPolygon& polygon : polygons) {
    Outline outline = outline_of(polygon, setting.frame);
    by_parts[{shape.triangle_part[polygon.upper_triangle], shape.triangle_part[polygon.lower_triangle]}].push_back(
        {std::move(polygon), std::move(outline)});
  }
  std::vector<ContactRegion> regions;
  for (const auto& [parts, patches] : by_parts) {
    std::vector<Outline> outlines;
    for (const Patch& patch : patches) outlines.push_back(patch.outline);
    for (const std::vector<std::size_t>& members : connected_outlines(outlines, setting.reach)) {
      regions.push_back(make_region(patches, members, setting));
      regions.back().upper_part = parts.first;
      regions.back().lower_part = parts.second;
    }
  }
  std::stable_sort(regions.begin(), regions.end(), comes_first);
  return regions;
}

}  // namespace stackabilization
