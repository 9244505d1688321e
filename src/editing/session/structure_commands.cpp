// Commands that change the structure: the history begins anew.
#include <algorithm>
#include <map>
#include <utility>

#include "editing/session/session_implementation.h"
#include "editing/structure/pair_relations.h"
#include "editing/structure/strokes.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::editing {

namespace {

/// Adds relations where they belong: symmetries before joints, then by parts.
void add_relations(const std::vector<Relation>& added, Structure& structure) {
  structure.relations.insert(structure.relations.end(), added.begin(), added.end());
  std::stable_sort(structure.relations.begin(), structure.relations.end(),
                   [](const Relation& a, const Relation& b) {
                     return std::pair(a.is_joint(), a.parts) < std::pair(b.is_joint(), b.parts);
                   });
}

}  // namespace

void EditingSession::Implementation::open(Document document, SessionOptions options) {
  expect_usable(document, options);
  auto workspace = std::make_shared<const Workspace>(document.project, document.requirements);
  earlier_.clear();
  options_ = std::move(options);
  load(std::move(document), std::move(workspace));
}

void EditingSession::Implementation::load(Document document) {
  auto workspace = std::make_shared<const Workspace>(document.project, document.requirements);
  load(std::move(document), std::move(workspace));
}

void EditingSession::Implementation::load(Document document, std::shared_ptr<const Workspace> workspace) {
  lanes_.cancel(Lane::automatic);
  found_ = {};
  finding_wanted_.reset();
  designs_ = {};
  workspace_ = std::move(workspace);
  document_ = std::move(document);
  load_node();
  emit(Changed{Change::structure});
  emit(Changed{Change::wishes});
  emit(Changed{Change::found});
  announce_node();
}

void EditingSession::Implementation::replace_structure(StructuredShape structured) {
  Document fresh = new_document(std::move(structured), document_.requirements.measure);
  const HistoryNode& old = document_.project.history.nodes.front();
  HistoryNode& root = fresh.project.history.nodes.front();
  root.direction = old.direction;
  root.stackability =
      stackability(fresh.project.rest.shape, Direction(root.direction), fresh.requirements.measure).value;
  fresh.source = document_.source;
  const Requirements& wishes = document_.requirements;
  fresh.requirements.target = wishes.target;
  fresh.requirements.length_limit = wishes.length_limit;
  fresh.requirements.keep_height = wishes.keep_height;
  fresh.requirements.quality = wishes.quality;
  Document before = document_;
  load(std::move(fresh));
  earlier_.push_back(std::move(before));
  emit(Changed{Change::tree});
}

void EditingSession::Implementation::analyse(const Shape& shape,
                                             const std::map<std::string, PrimitiveKind>& forced) {
  AnalysisOptions options;
  options.segmentation.method = SegmentationMethod::given;
  options.max_parts = DeformationLimits().max_parts;
  options.kinds = forced;
  replace_structure(analyse_structure(shape, options));
}

void EditingSession::Implementation::run(const Segment& command) {
  analyse(segment_by_strokes(workspace_->space().rest().shape, command.strokes), {});
}

void EditingSession::Implementation::run(const SetKind& command) {
  const Structure& structure = workspace_->space().rest().structure;
  expect_row(command.part, structure.parts.size(), "part");
  std::map<std::string, PrimitiveKind> kinds;
  for (const Part& part : structure.parts)
    kinds[part.name] =
        std::holds_alternative<Cuboid>(part.primitive) ? PrimitiveKind::cuboid : PrimitiveKind::cylinder;
  // Symmetric parts have primitives of one kind.
  for (const std::vector<int>& members : symmetric_classes(structure))
    if (std::find(members.begin(), members.end(), command.part) != members.end())
      for (const int part : members)
        kinds[structure.parts[static_cast<std::size_t>(part)].name] = command.kind;
  analyse(workspace_->space().rest().shape, kinds);
}

void EditingSession::Implementation::run(const RemoveRelations& command) {
  StructuredShape structured = workspace_->space().rest();
  std::vector<Relation>& relations = structured.structure.relations;
  if (command.relations.empty()) throw UsageError("no relation was named");
  std::vector<int> rows = command.relations;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (const int row : rows) expect_row(row, relations.size(), "relation");
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) relations.erase(relations.begin() + *row);
  replace_structure(std::move(structured));
}

void EditingSession::Implementation::run(const RemoveParts& command) {
  if (command.parts.empty()) throw UsageError("no part was named");
  replace_structure(without_parts(workspace_->space().rest(), command.parts));
}

void EditingSession::Implementation::run(const Join& command) {
  StructuredShape structured = workspace_->space().rest();
  for (const int part : command.parts) expect_row(part, structured.structure.parts.size(), "part");
  add_relations(joints_between(structured, command.parts[0], command.parts[1]), structured.structure);
  replace_structure(std::move(structured));
}

void EditingSession::Implementation::run(const MakeSymmetric& command) {
  StructuredShape structured = workspace_->space().rest();
  for (const int part : command.parts) expect_row(part, structured.structure.parts.size(), "part");
  add_relations({symmetry_between(structured, command.parts[0], command.parts[1])}, structured.structure);
  try {
    symmetrize(structured.structure);
  } catch (const InputError& contradiction) {
    throw UsageError(contradiction.what());
  }
  replace_structure(std::move(structured));
}

}  // namespace stackabilization::editing
