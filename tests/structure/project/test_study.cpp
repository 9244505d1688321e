// The relations that the paper's authors listed by hand for their study, against what is found.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/ctrl_grp_files.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

struct Model {
  const char *mesh, *controls, *groups, *labels;
};

constexpr const char* study = "user-study-graphics/UserStudyApp/data/";
constexpr const char* program = "stacker/data/";

/// How often a relation of one type is listed between the same parts; of planes of a part, up to two.
using Counts = std::map<std::string, int>;

Counts counts_of(const Structure& structure, RelationType type) {
  Counts counts;
  for (const Relation& relation : structure.relations) {
    if (relation.type != type ||
        (relation.points.rows() == 0 && relation.symmetry.kind != SymmetryKind::reflection))
      continue;
    std::vector<std::string> names;
    for (const int part : relation.parts)
      names.push_back(structure.parts[static_cast<std::size_t>(part)].name);
    std::sort(names.begin(), names.end());
    std::string key;
    for (const std::string& name : names) key += " " + name;
    ++counts[key];
  }
  return counts;
}

/// Two point joints on a line joint hold the same line: a rail on two pegs, which one takes for a cuboid, the
/// other for a curve. They count as that line joint.
Counts as_lines(Counts points, Counts& lines, const Counts& listed_lines) {
  for (const auto& [key, times] : listed_lines)
    if (lines.count(key) == 0 && points[key] == 2 * times) {
      std::cout << "  as two points" << key << "\n";
      points.erase(key);
      lines[key] = times;
    }
  return points;
}

struct RelationScore {
  int listed = 0, found = 0, both = 0;

  void add(const Counts& hand, const Counts& ours, const std::string& type) {
    for (const auto& [key, times] : hand) {
      const int mine = ours.count(key) > 0 ? ours.at(key) : 0;
      listed += times;
      both += std::min(times, mine);
      if (mine < times) std::cout << "  missing " << type << key << "\n";
    }
    for (const auto& [key, times] : ours) {
      const int theirs = hand.count(key) > 0 ? hand.at(key) : 0;
      found += times;
      if (times > theirs) std::cout << "  not listed " << type << key << " (" << times - theirs << ")\n";
    }
  }

  double recall() const { return listed > 0 ? static_cast<double>(both) / listed : 1; }
  double precision() const { return found > 0 ? static_cast<double>(both) / found : 1; }
};

}  // namespace

TEST_CASE("the relations listed by hand for the study are found") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (!folder) {
    std::cout << "SKIPPED: STACKABILIZATION_PAPER_DATA does not name the folder of the authors' data\n";
    return;
  }
  const std::string root = std::string(folder) + "/" + study;
  RelationScore pairs, selves, joints;
  for (const std::string& name :
       {std::string("Tasks/IKEA-cup"), std::string("Tasks/cup"), std::string("Tasks/cup-handle-01"),
        std::string("Tasks/stool-01"), std::string("Tasks/table-midbar"), std::string("table"),
        std::string("tableGC")}) {
    const Shape shape = read_shape(root + name + ".obj");
    const Structure hand = read_ctrl_grp(shape, {root + name + ".ctrl", root + name + ".grp"});
    AnalysisOptions options;
    options.segmentation.method = SegmentationMethod::given;
    const Structure ours = analyse_structure(shape, options).structure;
    std::cout << name << "\n";
    RelationScore pair, self, joint;
    pair.add(counts_of(hand, RelationType::symmetry), counts_of(ours, RelationType::symmetry), "pair");
    const Counts hand_lines = counts_of(hand, RelationType::line_joint);
    Counts lines = counts_of(ours, RelationType::line_joint);
    joint.add(counts_of(hand, RelationType::point_joint),
              as_lines(counts_of(ours, RelationType::point_joint), lines, hand_lines), "point joint");
    joint.add(hand_lines, lines, "line joint");
    // Planes were listed for few parts only: what counts is that those are found.
    Counts listed = counts_of(hand, RelationType::self_symmetry),
           found = counts_of(ours, RelationType::self_symmetry);
    for (auto part = found.begin(); part != found.end();)
      part = listed.count(part->first) > 0 ? std::next(part) : found.erase(part);
    self.add(listed, found, "plane");
    for (const auto& [score, label] :
         {std::pair(pair, "pairs"), std::pair(self, "planes"), std::pair(joint, "joints")})
      std::cout << "  " << label << ": " << score.listed << " listed, " << score.found << " found, recall "
                << score.recall() << ", precision " << score.precision() << "\n";
    for (const auto& [all, one] :
         {std::pair(&pairs, pair), std::pair(&selves, self), std::pair(&joints, joint)}) {
      all->listed += one.listed;
      all->found += one.found;
      all->both += one.both;
    }
  }
  CHECK(pairs.recall() >= 0.95);
  CHECK(pairs.precision() >= 0.95);
  CHECK(selves.recall() >= 0.95);
  CHECK(joints.recall() >= 0.95);
  CHECK(joints.precision() >= 0.95);
}

TEST_CASE("every file of the authors' program is read") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (!folder) {
    std::cout << "SKIPPED: STACKABILIZATION_PAPER_DATA does not name the folder of the authors' data\n";
    return;
  }
  const std::string root = std::string(folder) + "/" + program;
  for (const Model& model :
       {Model{"table.obj", "tableGC30.ctrl", "table_GC.grp", nullptr},
        {"table.obj", nullptr, "table.grp", nullptr},
        {"RESULTS/Suggestion/52.obj", nullptr, "RESULTS/Suggestion/52.grp", "RESULTS/Suggestion/52.seg"},
        {"test_cases/table02.obj", "test_cases/table02.ctrl", "test_cases/table02.grp",
         "test_cases/table02.seg"}}) {
    INFO(model.mesh << " " << model.groups);
    ReadOptions options;
    if (model.labels) options.labels = root + model.labels;
    CtrlGrpFiles files{{}, root + model.groups};
    if (model.controls) files.controls = root + model.controls;
    const Structure structure = read_ctrl_grp(read_shape(root + model.mesh, options), files);
    CHECK(!structure.relations.empty());
  }
}

TEST_CASE("open legs that stick in a seat are joined to it where they are, not all around it") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (folder == nullptr) {
    std::cout << "SKIPPED: STACKABILIZATION_PAPER_DATA is not set\n";
    return;
  }
  const Shape shape = read_shape(std::filesystem::path(folder) / program / "RESULTS/Gallery/42.obj");
  const Structure structure = analyse_structure(shape).structure;
  Counts points = counts_of(structure, RelationType::point_joint);
  CHECK(points[" Seat leg1"] == 1);
  CHECK(points[" Seat leg2"] == 1);
  CHECK(points[" Back leg3"] == 1);
  CHECK(points[" Back leg4"] == 1);
}
