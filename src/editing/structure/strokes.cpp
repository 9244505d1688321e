#include "editing/structure/strokes.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "stackabilization/core/errors.h"

namespace stackabilization::editing {

namespace {

/// Strokes in the order of first use, those of one name together, each triangle once.
std::vector<PartSeeds> merged(const Shape& shape, const std::vector<PartSeeds>& strokes) {
  std::vector<PartSeeds> result;
  std::map<std::int32_t, std::string> owner;
  for (const PartSeeds& stroke : strokes) {
    if (stroke.name.empty() || stroke.triangles.empty())
      throw UsageError("a stroke needs the name of a part and at least one triangle");
    auto known = std::find_if(result.begin(), result.end(),
                              [&](const PartSeeds& one) { return one.name == stroke.name; });
    if (known == result.end()) known = result.insert(result.end(), PartSeeds{stroke.name, {}});
    for (const std::int32_t triangle : stroke.triangles) {
      if (triangle < 0 || triangle >= shape.triangle_count())
        throw UsageError("there is no triangle " + std::to_string(triangle) + " to stroke");
      const auto [place, is_new] = owner.emplace(triangle, stroke.name);
      if (is_new)
        known->triangles.push_back(triangle);
      else if (place->second != stroke.name)
        throw UsageError("strokes of '" + place->second + "' and '" + stroke.name + "' cross each other");
    }
  }
  return result;
}

/// Names of the strokes in each part that has any.
std::map<std::int32_t, std::set<std::string>> names_in_parts(const Shape& shape,
                                                             const std::vector<PartSeeds>& strokes) {
  std::map<std::int32_t, std::set<std::string>> names;
  for (const PartSeeds& stroke : strokes)
    for (const std::int32_t triangle : stroke.triangles)
      names[shape.triangle_part[static_cast<std::size_t>(triangle)]].insert(stroke.name);
  return names;
}

/// Gives the parts new rows, in the order of their first triangles, without those that have none.
Shape with_parts(const Shape& shape, const std::vector<std::string>& part_of_triangle) {
  Shape result = shape;
  result.part_names.clear();
  std::map<std::string, std::int32_t> rows;
  for (std::size_t t = 0; t < part_of_triangle.size(); ++t) {
    const auto [place, is_new] =
        rows.emplace(part_of_triangle[t], static_cast<std::int32_t>(result.part_names.size()));
    if (is_new) result.part_names.push_back(part_of_triangle[t]);
    result.triangle_part[t] = place->second;
  }
  return result;
}

}  // namespace

Shape segment_by_strokes(const Shape& shape, const std::vector<PartSeeds>& strokes) {
  const std::vector<PartSeeds> seeds = merged(shape, strokes);
  if (seeds.empty()) throw UsageError("there is no stroke");
  const auto touched = names_in_parts(shape, seeds);
  for (const auto& [part, names] : touched) {
    const std::string& own = shape.part_names[static_cast<std::size_t>(part)];
    if (names.size() == 1 && !names.contains(own))
      throw UsageError("all of '" + own + "' would become '" + *names.begin() +
                       "': a second stroke has to say what stays");
  }
  std::vector<std::int32_t> rows;  // of the triangles that are cut anew
  std::map<std::int32_t, std::int32_t> place;
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t)
    if (touched.contains(shape.triangle_part[static_cast<std::size_t>(t)])) {
      place[t] = static_cast<std::int32_t>(rows.size());
      rows.push_back(t);
    }
  Shape open = shape;
  open.triangles = shape.triangles(rows, Eigen::all);
  open.part_names = {"part"};
  open.triangle_part.assign(rows.size(), 0);
  std::vector<PartSeeds> local = seeds;
  for (PartSeeds& one : local)
    for (std::int32_t& triangle : one.triangles) triangle = place.at(triangle);
  const Shape cut = segment(open, local);
  std::vector<std::string> names;
  for (const std::int32_t part : shape.triangle_part)
    names.push_back(shape.part_names[static_cast<std::size_t>(part)]);
  for (std::size_t k = 0; k < rows.size(); ++k)
    names[static_cast<std::size_t>(rows[k])] = cut.part_names[static_cast<std::size_t>(cut.triangle_part[k])];
  return with_parts(shape, names);
}

}  // namespace stackabilization::editing
