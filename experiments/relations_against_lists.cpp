// Question: does the analysis of a shape find the relations that people, or other programs, have listed for
// it?
//
//     relations_against_lists [--paper-data FOLDER] [--ikea FOLDER] [--threads N] [-o FILE.csv]
//
// --paper-data: every `.grp` file of the authors' data is compared with what analyse_structure finds on the
// OBJ file of the same name beside it (dashes and underscores being one). --ikea: every JSON file with a list
// of joined parts is compared with the pairs of parts that get a joint.
//
// One row per model and kind of relation: how many are listed, found, and both; recall and precision; what is
// missing and what is not listed. A self-symmetry counts once per part, joints as often as a pair of parts
// has them. The last rows are the sums. Exit status 3 when a folder holds nothing to compare.

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/provenance.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/labels.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/shape/write_file.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/authors_files.h"

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
    const bool is_joint =
        relation.type == RelationType::point_joint || relation.type == RelationType::line_joint;
    count = is_joint ? count + 1 : 1;
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
class Table {
 public:
  void add(const fs::path& model, const std::string& list, const Relations& listed, const Relations& found) {
    const std::string place = model.filename().string() + "," + file_hash(model) + "," + list + ",";
    std::map<std::string, int> kinds;
    for (const auto& [kind, relations] : listed) kinds[kind];
    for (const auto& [kind, relations] : found) kinds[kind];
    for (const auto& [kind, none] : kinds) {
      const auto of_kind = [&, &name = kind](const Relations& relations) {
        const auto entry = relations.find(name);
        return entry == relations.end() ? std::map<std::string, int>() : entry->second;
      };
      const Counts counts = compare(of_kind(listed), of_kind(found));
      rows_ += place + kind + row(counts);
      sums_[kind] += counts;
    }
  }

  bool empty() const { return rows_.empty(); }

  std::string text() const {
    std::string all =
        "model,input_hash,list,kind,listed,found,both,recall,precision,missing,not_listed\n" + rows_;
    for (const auto& [kind, counts] : sums_) all += "all,,," + kind + row(counts);
    return all;
  }

 private:
  static std::string row(const Counts& counts) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, ",%d,%d,%d,%.4f,%.4f,", counts.listed, counts.found, counts.both,
                  share(counts.both, counts.listed), share(counts.both, counts.found));
    return numbers + counts.missing + "," + counts.unlisted + "\n";
  }

  std::string rows_;
  std::map<std::string, Counts> sums_;
};

/// Files below a folder with one extension, sorted by path.
std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == extension) files.push_back(it->path());
  if (error) throw InputError(folder.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

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

void compare_groups(const fs::path& folder, Table& table) {
  for (const fs::path& groups : files_below(folder, ".grp")) {
    const fs::path model = sibling(groups, ".obj");
    if (model.empty()) continue;
    const Shape shape = labelled(model, sibling(groups, ".seg"));
    AuthorsFiles files{.controls = {}, .groups = groups};
    if (const fs::path controls = sibling(groups, ".ctrl"); !controls.empty()) files.controls = controls;
    AnalysisOptions given;
    given.segmentation.method = SegmentationMethod::given;
    table.add(model, groups.filename().string(), relations_of(read_authors_structure(shape, files)),
              relations_of(analyse_structure(shape, given).structure));
  }
}

void compare_joined_parts(const fs::path& folder, Table& table) {
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
    table.add(model, list.filename().string(), listed, found);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Does the analysis of a shape find the relations that people, or other programs, have listed?"};
  int threads = tbb::info::default_concurrency();
  std::string output = "-", paper_data, ikea;
  app.add_option("--paper-data", paper_data, "folder of the authors' data, with .grp files");
  app.add_option("--ikea", ikea, "folder of furniture with lists of joined parts");
  app.add_option("--threads", threads, "threads of the analysis")->check(CLI::Range(1, 1024));
  app.add_option("-o", output, "CSV file; - is standard output");
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  try {
    Table table;
    if (!paper_data.empty()) compare_groups(paper_data, table);
    if (!ikea.empty()) compare_joined_parts(ikea, table);
    if (table.empty())
      throw InputError("nothing to compare: no folder given, or no list beside a mesh in it");
    write_file_atomically(
        output, provenance_lines(
                    {"relations_against_lists", std::vector<std::string>(argv + 1, argv + argc), threads}) +
                    table.text());
    return 0;
  } catch (const InputError& error) {
    std::cerr << "relations_against_lists: " << error.what() << "\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "relations_against_lists: " << error.what() << "\n";
    return 2;
  }
}
