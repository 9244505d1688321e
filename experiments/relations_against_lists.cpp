// Question: does the analysis of a shape find the relations that people, or other programs, have listed for
// it?
//
//     relations_against_lists [--paper-data FOLDER] [--ikea FOLDER] [--threads N] [-o FOLDER]
//
// --paper-data: every `.grp` file of the authors' data is compared with what analyse_structure finds on the
// OBJ file of the same name beside it (dashes and underscores being one). --ikea: every JSON file with a list
// of joined parts is compared with the pairs of parts that get a joint.
//
// One row per model and kind of relation: how many are listed, found, and both; recall and precision; what is
// missing and what is not listed. A self-symmetry counts once per part, joints as often as a pair of parts
// has them. The last rows are the sums. Exit status 3 when a folder holds nothing to compare.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/experiment.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/labels.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/ctrl_grp_files.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace fs = std::filesystem;

namespace {

/// How often each relation occurs, by kind and parts.
using Relations = std::map<std::string, std::map<std::string, int>>;

std::string parts_text(const Structure& structure, const Relation& relation) {
  std::vector<std::string> names;
  for (const int part : relation.parts) names.push_back(structure.parts[static_cast<std::size_t>(part)].name);
  std::sort(names.begin(), names.end());
  return names.size() == 1 ? names[0] : names[0] + "-" + names[1];
}

Relations relations_of(const Structure& structure) {
  Relations relations;
  for (const Relation& relation : structure.relations) {
    int& count = relations[name_of(relation.type)][parts_text(structure, relation)];
    count = relation.is_joint() ? count + 1 : 1;
  }
  return relations;
}

struct Counts {
  int listed = 0, found = 0, both = 0;
  std::string missing, unlisted;

  Counts& operator+=(const Counts& other) {
    listed += other.listed;
    found += other.found;
    both += other.both;
    return *this;
  }
};

Counts compare(const std::map<std::string, int>& listed, const std::map<std::string, int>& found) {
  std::map<std::string, std::array<int, 2>> all;
  for (const auto& [parts, count] : listed) all[parts][0] = count;
  for (const auto& [parts, count] : found) all[parts][1] = count;
  Counts counts;
  for (const auto& [parts, both] : all) {
    counts.listed += both[0];
    counts.found += both[1];
    counts.both += std::min(both[0], both[1]);
    for (int k = both[1]; k < both[0]; ++k) counts.missing += parts + " ";
    for (int k = both[0]; k < both[1]; ++k) counts.unlisted += parts + " ";
  }
  return counts;
}

double share(int part, int whole) {
  return whole == 0 ? 1 : static_cast<double>(part) / whole;
}

/// Rows of the table and their sums.
class Comparison {
 public:
  explicit Comparison(Table& table) : table_(table) {}

  void add(const fs::path& model, const std::string& list, const Relations& listed, const Relations& found) {
    std::map<std::string, int> kinds;
    for (const auto& [kind, relations] : listed) kinds[kind];
    for (const auto& [kind, relations] : found) kinds[kind];
    for (const auto& [kind, none] : kinds) {
      const auto of_kind = [&, &name = kind](const Relations& relations) {
        const auto entry = relations.find(name);
        return entry == relations.end() ? std::map<std::string, int>() : entry->second;
      };
      const Counts counts = compare(of_kind(listed), of_kind(found));
      add_row(model.filename().string(), file_hash(model), list, kind, counts);
      sums_[kind] += counts;
    }
  }

  void add_sums() {
    for (const auto& [kind, counts] : sums_) add_row("all", "", "", kind, counts);
  }

 private:
  void add_row(const std::string& model, const std::string& hash, const std::string& list,
               const std::string& kind, const Counts& counts) {
    table_.add({model, hash, list, kind, std::int64_t{counts.listed}, std::int64_t{counts.found},
                std::int64_t{counts.both}, share(counts.both, counts.listed),
                share(counts.both, counts.found), counts.missing, counts.unlisted});
  }

  Table& table_;
  std::map<std::string, Counts> sums_;
};

/// The file of the same name with another extension, dashes and underscores being one; empty when there is
/// none.
fs::path sibling(const fs::path& file, const std::string& extension) {
  const auto plain = [](std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  };
  for (const fs::path& other : files_below(file.parent_path(), extension))
    if (plain(other.stem().string()) == plain(file.stem().string())) return other;
  return {};
}

/// With the parts of the labels; of the mesh file where the labels are of another mesh, as one of the
/// authors' is.
Shape labelled(const fs::path& model, const fs::path& labels) {
  Shape shape = read_shape(model);
  try {
    return labels.empty() ? shape : with_labels(shape, labels);
  } catch (const InputError& error) {
    std::cerr << "relations_against_lists: labels not used: " << error.what() << "\n";
    return shape;
  }
}

void compare_groups(const fs::path& folder, Comparison& comparison) {
  for (const fs::path& groups : files_below(folder, ".grp")) {
    const fs::path model = sibling(groups, ".obj");
    if (model.empty()) continue;
    const Shape shape = labelled(model, sibling(groups, ".seg"));
    CtrlGrpFiles files{.controls = {}, .groups = groups};
    if (const fs::path controls = sibling(groups, ".ctrl"); !controls.empty()) files.controls = controls;
    AnalysisOptions given;
    given.segmentation.method = SegmentationMethod::given;
    comparison.add(model, groups.filename().string(), relations_of(read_ctrl_grp(shape, files)),
                   relations_of(analyse_structure(shape, given).structure));
  }
}

void compare_joined_parts(const fs::path& folder, Comparison& comparison) {
  for (const fs::path& list : files_below(folder, ".json")) {
    const fs::path model = sibling(list, ".obj");
    if (model.empty()) continue;
    std::ifstream file(list);
    const nlohmann::json document = nlohmann::json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains("joints"))
      throw InputError(list.string() + ": expected a JSON object with a list 'joints'");
    Relations listed, found;
    for (const auto& pair : document["joints"]) {
      std::array<std::string, 2> names = {pair.at(0), pair.at(1)};
      std::sort(names.begin(), names.end());
      listed["joined parts"][names[0] + "-" + names[1]] = 1;
    }
    for (const auto& [kind, relations] : relations_of(analyse_structure(read_shape(model)).structure))
      if (kind == "point_joint" || kind == "line_joint")
        for (const auto& [parts, count] : relations) found["joined parts"][parts] = 1;
    comparison.add(model, list.filename().string(), listed, found);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(
      "relations_against_lists",
      "Does the analysis of a shape find the relations that people, or other programs, have listed?",
      Inputs::none);
  fs::path paper_data, ikea;
  experiment.app().add_option("--paper-data", paper_data, "folder of the authors' data, with .grp files");
  experiment.app().add_option("--ikea", ikea, "folder of furniture with lists of joined parts");
  return experiment.run(argc, argv, [&](Report& report) {
    Table& table = report.table("", columns({"model", "input_hash", "list", "kind", "listed", "found", "both",
                                             "recall", "precision", "missing", "not_listed"}));
    Comparison comparison(table);
    if (!paper_data.empty()) compare_groups(paper_data, comparison);
    if (!ikea.empty()) compare_joined_parts(ikea, comparison);
    if (table.rows().empty())
      throw InputError("nothing to compare: no folder given, or no list beside a mesh in it");
    comparison.add_sums();
  });
}
