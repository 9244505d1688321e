// Question: how long does the analysis of a shape take, how long an edit of its controllers with everything
// that follows from it, and how long a step of a drag in the editor?
//
//     deformation_speed MODEL... [--triangles N] [--edits N] [--seed N] [-o FOLDER]
//
// One row per model, on one core: milliseconds of the analysis (segmentation, primitives with skeletons,
// symmetries, joints) of the model as given; then, on its mesh with the longest edges cut until it has N
// triangles (default 10,000), milliseconds to prepare the controllers, and median and largest milliseconds of
// an accepted edit - moves, turns and scalings of a few per cent of random handles, each from rest - in two
// shares: propagation and solve, and the transfer to the mesh. edit_ms and transfer_ms are medians of each,
// total_ms and slowest_ms median and largest of their sum. drag_ms and slowest_drag_ms are the same of the
// same edits as steps of a drag in an editing session, refused ones included: the largest part of the edit
// that all limits allow, S of the design, and its measures of quality.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "common/clock.h"
#include "common/experiment.h"
#include "common/random.h"
#include "common/statistics.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/editing/session.h"
#include "stackabilization/structure/analysis.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

struct Options {
  int triangles = 10000, edits = 200;
  unsigned seed = 1;
};

using EdgeTriangles = std::map<std::pair<int, int>, std::vector<Eigen::Index>>;

EdgeTriangles edges_of(const Shape& shape) {
  EdgeTriangles edges;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      edges[std::minmax(shape.triangles(t, k), shape.triangles(t, (k + 1) % 3))].push_back(t);
  return edges;
}

/// Cuts a triangle in two at the middle of one of its edges. Appends one half.
void cut(Shape& shape, Eigen::Index triangle, const std::pair<int, int>& edge, int middle) {
  Eigen::RowVector3i one = shape.triangles.row(triangle), other = one;
  for (int k = 0; k < 3; ++k) {
    if (one[k] == edge.first) one[k] = middle;
    if (other[k] == edge.second) other[k] = middle;
  }
  shape.triangles.row(triangle) = one;
  shape.triangles.conservativeResize(shape.triangles.rows() + 1, 3);
  shape.triangles.bottomRows<1>() = other;
  shape.triangle_part.push_back(shape.triangle_part[static_cast<std::size_t>(triangle)]);
}

/// Cuts edges at their middles, the longest ones first, until a shape has so many triangles. In each round a
/// triangle is cut once at most.
Shape refine(Shape shape, Eigen::Index triangles) {
  while (shape.triangle_count() < triangles) {
    const EdgeTriangles edges = edges_of(shape);
    std::vector<std::pair<double, EdgeTriangles::const_iterator>> longest;
    for (auto edge = edges.begin(); edge != edges.end(); ++edge)
      longest.emplace_back(
          -(shape.vertices.row(edge->first.first) - shape.vertices.row(edge->first.second)).norm(), edge);
    std::stable_sort(longest.begin(), longest.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<bool> was_cut(static_cast<std::size_t>(shape.triangle_count()));
    for (const auto& [length, edge] : longest) {
      if (shape.triangle_count() >= triangles) break;
      const auto& [ends, around] = *edge;
      if (std::any_of(around.begin(), around.end(),
                      [&](Eigen::Index t) { return was_cut[static_cast<std::size_t>(t)]; }))
        continue;
      const Eigen::RowVector3d middle =
          (shape.vertices.row(ends.first) + shape.vertices.row(ends.second)) / 2;
      shape.vertices.conservativeResize(shape.vertex_count() + 1, 3);
      shape.vertices.bottomRows<1>() = middle;
      for (const Eigen::Index t : around) {
        was_cut[static_cast<std::size_t>(t)] = true;
        cut(shape, t, ends, static_cast<int>(shape.vertex_count()) - 1);
      }
    }
  }
  return shape;
}

Eigen::Vector3d random_axis(Random& random) {
  return (random.uniform() < 0.5 ? 1 : -1) *
         Eigen::Vector3d::Unit(static_cast<Eigen::Index>(3 * random.uniform()));
}

Edit random_edit(const std::vector<Handle>& handles, double diagonal, Random& random) {
  Edit edit;
  edit.handle = handles[static_cast<std::size_t>(random.uniform() * static_cast<double>(handles.size()))];
  const double choice = random.uniform();
  if (choice < 0.2 && (edit.handle.kind == HandleKind::part || edit.handle.kind == HandleKind::face))
    edit.operation = Rotate{random_axis(random), 0.1 * (2 * random.uniform() - 1)};
  else if (choice < 0.5 && edit.handle.kind != HandleKind::corner)
    edit.operation = Scale{0.9 + 0.2 * random.uniform(), std::nullopt};
  else
    edit.operation = Move{0.03 * diagonal * random.uniform() * random_axis(random)};
  return edit;
}

struct EditTimes {
  std::vector<double> edit, transfer, total;  ///< milliseconds of accepted edits
};

EditTimes time_edits(const ControllerModel& model, const Options& options) {
  const std::vector<Handle> handles = model.handles();
  const Design rest = model.at_rest();
  Random random(options.seed);
  EditTimes times;
  for (int i = 0; i < options.edits; ++i) {
    const Edit edit = random_edit(handles, model.rest().structure.diagonal, random);
    const double start = now();
    const DeformationResult outcome = model.edited(rest, edit);
    const double edited = now();
    if (outcome.refusal) continue;
    // The edit makes the mesh at its end; made once more, it is timed alone.
    const Shape shape = model.shape_of(outcome.design.primitives);
    const double transfer = now() - edited;
    times.edit.push_back(1e3 * (edited - start - transfer));
    times.transfer.push_back(1e3 * transfer);
    times.total.push_back(1e3 * (edited - start));
  }
  return times;
}

/// Returns milliseconds of each step of a drag.
std::vector<double> time_drags(const StructuredShape& structured, const Options& options) {
  using namespace stackabilization::editing;
  EditingSession session(new_document(structured), {}, [](const Event& /*event*/) {});
  const std::vector<Handle> handles = session.space().handles();
  Random random(options.seed);
  std::vector<double> times;
  for (int i = 0; i < options.edits; ++i) {
    const Drag step{random_edit(handles, structured.structure.diagonal, random)};
    const double start = now();
    session.execute(step);
    times.push_back(1e3 * (now() - start));
  }
  session.execute(EndDrag{false});
  return times;
}

void add_row(const ModelFile& file, const Shape& shape, const std::string& hash, const Options& options,
             Table& table) {
  double start = now();
  StructuredShape structured = analyse_structure(shape);
  const double analysis_ms = 1e3 * (now() - start);
  structured.shape = refine(std::move(structured.shape), options.triangles);
  const std::int64_t triangles = structured.shape.triangle_count();
  const auto parts = static_cast<std::int64_t>(structured.structure.parts.size());
  const auto relations = static_cast<std::int64_t>(structured.structure.relations.size());
  const std::vector<double> drags = time_drags(structured, options);
  start = now();
  const ControllerModel model(std::move(structured));
  const double prepare_ms = 1e3 * (now() - start);
  const EditTimes times = time_edits(model, options);
  if (times.total.empty()) throw InputError(file.path.string() + ": none of the edits was accepted");
  table.add({file.name, hash, std::int64_t{shape.triangle_count()}, parts, relations, triangles,
             std::int64_t{options.edits}, static_cast<std::int64_t>(times.total.size()), analysis_ms,
             prepare_ms, median(times.edit), median(times.transfer), median(times.total),
             quantile(times.total, 1), median(drags), quantile(drags, 1)});
}

Table& table_of(Report& report) {
  std::vector<Column> all = columns({"model", "input_hash"}, ColumnKind::key);
  for (const Column& column :
       columns({"triangles", "parts", "relations", "fine_triangles", "edits", "accepted"}))
    all.push_back(column);
  for (const Column& column : columns({"analysis_ms", "prepare_ms", "edit_ms", "transfer_ms", "total_ms",
                                       "slowest_ms", "drag_ms", "slowest_drag_ms"},
                                      ColumnKind::clock))
    all.push_back(column);
  return report.table("", all);
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(
      "deformation_speed",
      "How long do the analysis of a structure, an edit of its controllers and a step of a drag take?",
      Inputs::models, Threads::one);
  Options options;
  experiment.app()
      .add_option("--triangles", options.triangles, "cut edges until a mesh has this many")
      ->check(CLI::Range(1, 1 << 24));
  experiment.app()
      .add_option("--edits", options.edits, "random edits per model")
      ->check(CLI::Range(1, 1000000));
  experiment.app().add_option("--seed", options.seed, "of the random edits");
  return experiment.run(argc, argv, [&](Report& report) {
    Table& table = table_of(report);
    for_each_model(experiment.models(), report,
                   [&](const ModelFile& file, const Shape& shape, const std::string& hash) {
                     add_row(file, shape, hash, options, table);
                   });
  });
}
