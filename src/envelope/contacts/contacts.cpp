#include "stackabilization/envelope/contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/bounding_diagonal.h"
#include "envelope/contacts/contact_polygons.h"
#include "envelope/contacts/planar_union.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {
namespace {

using namespace detail;

/// A contact polygon with its outline in the plane orthogonal to r.
struct Patch {
  ContactPolygon polygon;
  ConvexPolygon outline;
};

/// Consecutive patches [first, last) that are treated as one outline in the plane.
struct Tile {
  ConvexPolygon outline;
  std::size_t first, last;
};

/// Data of one query.
struct Setting {
  Frame frame;
  ContactOptions options;
  double reach;  ///< polygons this near to each other, in model units, touch
};

/// Returns the point that attains the separation, for contacts without area.
ContactPolygon witness_polygon(const Witness& witness) {
  ContactPolygon polygon{witness.upper_triangle, witness.lower_triangle, Points(1, 3), Points(1, 3)};
  polygon.upper_points.row(0) = witness.upper_point;
  polygon.lower_points.row(0) = witness.lower_point;
  return polygon;
}

/// Merges the patches of fully covered upper triangles. On dense meshes many small patches cover most upper
/// triangles completely; the triangle then replaces them. (Patches over one triangle whose overlaps and gaps
/// have exactly the same area would be mistaken for a full cover.)
std::vector<Tile> tiles(const std::vector<Patch>& patches, const Shape& shape, const Frame& frame) {
  std::vector<Tile> result;
  for (std::size_t first = 0; first < patches.size();) {
    const std::int32_t triangle = patches[first].polygon.upper_triangle;
    double area = 0;
    std::size_t last = first;
    for (; last < patches.size() && patches[last].polygon.upper_triangle == triangle; ++last)
      area += outline_area(patches[last].outline);
    const ConvexPolygon whole = outline_of(shape, triangle, frame);
    if (last - first > 1 && std::abs(area - outline_area(whole)) <= tolerance::relative * area) {
      result.push_back({whole, first, last});
    } else {
      for (std::size_t p = first; p < last; ++p) result.push_back({patches[p].outline, p, p + 1});
    }
    first = last;
  }
  return result;
}

struct Centres {
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
};

/// Centroids of the lifted polygons, weighted by their area seen along r; equal weights where all areas
/// vanish.
Centres centres_of(const std::vector<const Patch*>& patches) {
  Centres centres;
  double total = 0;
  for (const bool by_area : {true, false}) {
    for (const Patch* patch : patches) {
      const auto centroid = outline_centroid(patch->outline);
      const double weight = by_area ? outline_area(patch->outline) : 1;
      if (!(weight > 0)) continue;
      centres.upper += weight * (patch->polygon.upper_points.transpose() * centroid);
      centres.lower += weight * (patch->polygon.lower_points.transpose() * centroid);
      total += weight;
    }
    if (total > 0) break;
  }
  return {centres.upper / total, centres.lower / total};
}

/// Area, long axis, and ring, line or dot, from the union of the outlines.
ContactRegion classified(const std::vector<ConvexPolygon>& outlines, const Setting& setting) {
  ContactRegion region;
  region.area = union_area(outlines);
  const Elongation elongation = elongation_of(outlines);
  region.long_axis = setting.frame.u * elongation.axis.x() + setting.frame.v * elongation.axis.y();
  if (largest_hole(outlines) > setting.options.min_hole * elongation.length * elongation.width) {
    region.type = ContactType::ring;
  } else if (elongation.length > 0 && elongation.length >= setting.options.line_aspect * elongation.width) {
    region.type = ContactType::line;
  }
  return region;
}

/// The region of the listed tiles; takes the polygons out of their patches.
ContactRegion make_region(std::vector<Patch>& patches, const std::vector<Tile>& members,
                          const Setting& setting) {
  std::vector<const Patch*> chosen;
  std::vector<ConvexPolygon> outlines;
  for (const Tile& tile : members) {
    outlines.push_back(tile.outline);
    for (std::size_t p = tile.first; p < tile.last; ++p) chosen.push_back(&patches[p]);
  }
  ContactRegion region = classified(outlines, setting);
  const Centres centres = centres_of(chosen);
  region.upper_centre = centres.upper;
  region.lower_centre = centres.lower;
  for (const Tile& tile : members)
    for (std::size_t p = tile.first; p < tile.last; ++p)
      region.polygons.push_back(std::move(patches[p].polygon));
  return region;
}

/// All regions between one pair of parts.
std::vector<ContactRegion> regions_of(std::vector<Patch>& patches, const Shape& shape,
                                      const Setting& setting) {
  const std::vector<Tile> all = tiles(patches, shape, setting.frame);
  std::vector<ConvexPolygon> outlines;
  for (const Tile& tile : all) outlines.push_back(tile.outline);
  std::vector<ContactRegion> regions;
  for (const std::vector<std::size_t>& component : connected_outlines(outlines, setting.reach)) {
    std::vector<Tile> members;
    for (const std::size_t member : component) members.push_back(all[member]);
    regions.push_back(make_region(patches, members, setting));
  }
  return regions;
}

bool comes_first(const ContactRegion& a, const ContactRegion& b) {
  if (a.area != b.area) return a.area > b.area;
  return std::lexicographical_compare(a.upper_centre.data(), a.upper_centre.data() + 3, b.upper_centre.data(),
                                      b.upper_centre.data() + 3);
}

/// By pairs of parts: of the upper triangle, of the lower one.
using PatchesByParts = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Patch>>;

/// Returns the parts whose triangles have the same points as those of the polygons, except the parts named
/// there.
std::vector<std::int32_t> coincident_parts(const PatchesByParts& by_parts, const Shape& shape,
                                           const std::vector<TriangleCopy>& copies) {
  std::vector<char> touches(static_cast<std::size_t>(shape.triangle_count()), 0);
  std::vector<char> named(static_cast<std::size_t>(shape.part_count()), 0), unnamed = named;
  for (const auto& [parts, patches] : by_parts) {
    named[parts.first] = named[parts.second] = 1;
    for (const Patch& patch : patches)
      touches[patch.polygon.upper_triangle] = touches[patch.polygon.lower_triangle] = 1;
  }
  for (const TriangleCopy& copy : copies)
    if (touches[copy.first]) unnamed[shape.triangle_part[copy.copy]] = 1;
  std::vector<std::int32_t> parts;
  for (std::size_t part = 0; part < named.size(); ++part)
    if (unnamed[part] && !named[part]) parts.push_back(static_cast<std::int32_t>(part));
  return parts;
}

}  // namespace

Contacts contact_regions(const ContactQuery& query, const ContactOptions& options) {
  const auto& [shape, tree, direction, separation] = query;
  if (!(options.band >= 0 && options.band <= 1))
    throw UsageError("the contact band must lie between 0 and 1");
  if (!separation.blocked) return {};
  const Setting setting{frame_of(direction), options, tolerance::relative * bounding_diagonal(shape)};
  const double extent = range_along(shape, setting.frame.w).length() / direction.length();
  constexpr std::int64_t pairs_per_triangle = 8;
  ContactPolygons found = contact_polygons(
      tree.data(), direction,
      {options.semantics, separation.value.to_double() - options.band * extent,
       options.max_pairs + pairs_per_triangle * shape.triangle_count(), tolerance::relative * extent});
  if (found.polygons.empty()) found.polygons.push_back(witness_polygon(separation.witness));

  PatchesByParts by_parts;
  for (ContactPolygon& polygon : found.polygons) {
    ConvexPolygon outline = outline_of(polygon.upper_points, setting.frame);
    by_parts[{shape.triangle_part[polygon.upper_triangle], shape.triangle_part[polygon.lower_triangle]}]
        .push_back({std::move(polygon), std::move(outline)});
  }
  Contacts contacts;
  contacts.complete = found.complete;
  if (!found.complete) contacts.coincident_parts = coincident_parts(by_parts, shape, tree.data().copies);
  for (auto& [parts, patches] : by_parts)
    for (ContactRegion& region : regions_of(patches, shape, setting)) {
      region.upper_part = parts.first;
      region.lower_part = parts.second;
      contacts.regions.push_back(std::move(region));
    }
  std::stable_sort(contacts.regions.begin(), contacts.regions.end(), comes_first);
  return contacts;
}

Contacts contact_regions(const Shape& shape, const Direction& direction, const ContactOptions& options) {
  const SeparationTree tree(shape);
  const Separation found = separation(tree, tree, direction, {options.semantics, std::nullopt});
  return contact_regions({shape, tree, direction, found}, options);
}

CloseFit close_fit(const Shape& shape, const Direction& direction, const Contacts& contacts) {
  const Frame frame = frame_of(direction);
  std::vector<ConvexPolygon> close, all;
  for (const ContactRegion& region : contacts.regions)
    for (const ContactPolygon& polygon : region.polygons)
      close.push_back(outline_of(polygon.upper_points, frame));
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(shape.triangle_count()); ++t)
    all.push_back(outline_of(shape, t, frame));
  return {union_area(close), union_area(all), contacts.complete};
}

}  // namespace stackabilization
