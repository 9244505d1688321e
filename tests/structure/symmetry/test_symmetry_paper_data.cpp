#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "mesh/surface_index.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/labels.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/symmetry_detection.h"
#include "support/catch.h"

using namespace stackabilization;
namespace fs = std::filesystem;

namespace {

using Pair = std::set<std::string>;

/// What a hand-made list says, or what was found: pairs of parts, and per part the number of its mirror
/// planes.
struct Symmetries {
  std::set<Pair> pairs;
  std::map<std::string, int> own;
};

Symmetries listed_in(const fs::path& file) {
  Symmetries listed;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string type, first, second;
    int count = 0;
    words >> type;
    if (type == "SYMMETRY" && words >> count >> first >> second) listed.pairs.insert({first, second});
    if (type == "SELF_SYMMETRY" && words >> first >> count) listed.own[first] = count;
  }
  return listed;
}

Symmetries found_in(const Shape& shape, const std::vector<Relation>& relations) {
  const auto name = [&](int part) { return shape.part_names[static_cast<std::size_t>(part)]; };
  Symmetries found;
  for (const Relation& relation : relations)
    if (relation.type == RelationType::symmetry)
      found.pairs.insert({name(relation.parts[0]), name(relation.parts[1])});
    else if (relation.symmetry.kind == SymmetryKind::reflection)
      ++found.own[name(relation.parts[0])];
  return found;
}

/// The farthest that a vertex of the first part of `relation` is, mirrored, from the second; fraction of the
/// diagonal.
double farthest(const Shape& shape, const Relation& relation) {
  const double diagonal = (shape.vertices.colwise().maxCoeff() - shape.vertices.colwise().minCoeff()).norm();
  const Shape first = extract_part(shape, relation.parts.front());
  const SurfaceIndex second(extract_part(shape, relation.parts.back()));
  double most = 0;
  for (Eigen::Index v = 0; v < first.vertex_count(); ++v)
    most = std::max(
        most, second.nearest(isometry_of(relation.symmetry) * first.vertices.row(v).transpose()).distance);
  return most / diagonal;
}

/// The mesh that goes with a list, in parts; nothing where the data has none.
std::optional<Shape> shape_of(const fs::path& list) {
  fs::path mesh = fs::path(list).replace_extension(".obj");
  if (!fs::exists(mesh)) {
    std::string name = mesh.filename().string();
    std::replace(name.begin(), name.end(), '-', '_');
    mesh.replace_filename(name);
  }
  if (!fs::exists(mesh)) return {};
  const Shape shape = read_shape(mesh);
  const fs::path labels = mesh.replace_extension(".seg");
  if (!fs::exists(labels)) return shape;
  try {
    return with_labels(shape, labels);
  } catch (const InputError& error) {  // labels of another version of the mesh
    std::printf("%s: %s\n", list.filename().string().c_str(), error.what());
    return {};
  }
}

struct SymmetryScore {
  int listed = 0, found = 0, both = 0;
  void count(bool is_listed, bool is_found) {
    listed += is_listed;
    found += is_found;
    both += is_listed && is_found;
  }
};

}  // namespace

TEST_CASE("the symmetries that the authors listed by hand are found") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (folder == nullptr) {
    std::cout << "SKIPPED: set STACKABILIZATION_PAPER_DATA to the folder of the authors' data\n";
    return;
  }
  std::vector<fs::path> lists;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".grp") lists.push_back(entry.path());
  std::sort(lists.begin(), lists.end());

  SymmetryScore pairs, own;
  for (const fs::path& list : lists) {
    const std::optional<Shape> shape = shape_of(list);
    if (!shape) continue;
    CAPTURE(list.string());
    const std::vector<Relation> relations = symmetry_relations(*shape, find_symmetries(*shape));
    const Symmetries listed = listed_in(list), found = found_in(*shape, relations);

    SymmetryScore of_pairs, of_own;
    std::set<Pair> all = listed.pairs;
    all.insert(found.pairs.begin(), found.pairs.end());
    for (const Pair& pair : all) of_pairs.count(listed.pairs.count(pair) > 0, found.pairs.count(pair) > 0);
    for (const std::string& part : shape->part_names) {
      const auto planes = [&](const Symmetries& in) { return in.own.count(part) ? in.own.at(part) : 0; };
      of_own.count(planes(listed) > 0, planes(found) > 0 && planes(found) >= planes(listed));
    }
    // The lists leave out what bars and rims are symmetric in by themselves; what is found must hold for
    // every vertex.
    for (const Relation& relation : relations)
      if (relation.symmetry.kind == SymmetryKind::reflection) CHECK(farthest(*shape, relation) <= 0.03);

    std::printf("%-24s pairs: %d of %d listed, %d found; self-symmetric parts: %d of %d listed, %d found\n",
                list.filename().string().c_str(), of_pairs.both, of_pairs.listed, of_pairs.found, of_own.both,
                of_own.listed, of_own.found);
    for (auto [total, one] : {std::pair(&pairs, &of_pairs), std::pair(&own, &of_own)}) {
      total->listed += one->listed;
      total->found += one->found;
      total->both += one->both;
    }
  }
  REQUIRE(pairs.listed > 0);
  REQUIRE(own.listed > 0);
  CHECK(pairs.both >= 0.95 * pairs.listed);
  CHECK(own.both >= 0.95 * own.listed);
  CHECK(pairs.both >= 0.95 * pairs.found);
}
