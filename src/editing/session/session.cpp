#include "stackabilization/editing/session.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include "editing/session/handle_range.h"
#include "editing/session/node_designs.h"
#include "editing/session/workspace.h"
#include "editing/structure/strokes.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/write_file.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::editing {

namespace {

using Flag = std::shared_ptr<std::atomic<bool>>;
using Deliver = std::function<void(EditingSession::Result)>;

/// Efforts of the automatic search, fractions of the effort asked for: a first answer soon, then a better
/// one.
constexpr std::array<double, 2> effort_shares = {0.1, 1};

void expect_row(int row, std::size_t size, const std::string& what) {
  if (row < 0 || static_cast<std::size_t>(row) >= size)
    throw UsageError("there is no " + what + " " + std::to_string(row) + ", only " + std::to_string(size) +
                     " counted from 0");
}

/// Sine of the angle below which two drags are along one line: an amount that was possible is tried first.
constexpr double same_line_sine = 1.0 / 128;

/// Returns the name of a node: what changed most, or `otherwise` where nothing is seen.
std::string name_of(const Explanation& change, const std::string& otherwise) {
  return change.groups.empty() ? otherwise : describe(change.groups.front(), change);
}

}  // namespace

class EditingSession::Implementation {
 public:
  Implementation(Document document, SessionOptions options, Listener listener)
      : document_(std::move(document)), options_(std::move(options)), listener_(std::move(listener)) {
    if (options_.max_suggestions < 1) throw UsageError("at least one suggestion has to be offered");
    if (document_.project.history.nodes.empty() || document_.visited.empty())
      throw UsageError("a document has at least the node at rest");
    workspace_ = std::make_shared<const Workspace>(document_.project, document_.requirements);
    load_node();
  }

  ~Implementation() { cancel(); }

  void execute(const Command& command) {
    std::visit([this](const auto& one) { run(one); }, command);
  }

  std::optional<Job> next_job(Lane lane) {
    LaneState& state = lanes_[static_cast<std::size_t>(lane)];
    if (state.running) return std::nullopt;
    std::function<void(const Flag&, const Deliver&)> work;
    if (lane == Lane::automatic)
      work = automatic_work();
    else if ((range_runs_ = wanted_range_.has_value()))
      work = range_work();
    else if (!dragging_ && !review_)
      work = review_work();
    else if (!dragging_ && !suggested_)
      work = suggestion_work();
    if (!work) return std::nullopt;
    state.running = true;
    state.cancelled = std::make_shared<std::atomic<bool>>(false);
    return [this, lane, work = std::move(work), cancelled = state.cancelled](const Deliver& deliver) {
      try {
        work(cancelled, deliver);
      } catch (const std::exception& error) {
        deliver([this, sentence = std::string(error.what()), cancelled] {
          if (!*cancelled) emit(Failed{sentence});
        });
      }
      deliver([this, lane] { lanes_[static_cast<std::size_t>(lane)].running = false; });
    };
  }

  void cancel() {
    for (LaneState& lane : lanes_)
      if (lane.cancelled) *lane.cancelled = true;
  }

  Document document_;
  SessionOptions options_;
  Listener listener_;
  std::shared_ptr<const Workspace> workspace_;
  mutable NodeDesigns designs_;
  std::vector<Document> earlier_;  ///< documents before each change of the structure
  Direction direction_{0, 0, 1};
  Stackability at_rest_;
  MeasuredDesign current_;
  std::optional<MeasuredDesign> dragged_;
  bool dragging_ = false;
  std::optional<Edit> drag_edit_;  ///< edit of `dragged_`
  std::optional<Review> review_;
  std::vector<OfferedEdit> suggestions_;
  std::vector<ObstacleCount> refused_;
  bool suggested_ = false;  ///< whether all suggestions are known
  std::optional<Edit> wanted_range_;
  bool range_runs_ = false;  ///< whether the job of the lane of advice is a range
  std::optional<HandleRange> range_;
  FoundDesigns found_;
  bool finding_wanted_ = false;

 private:
  struct LaneState {
    bool running = false;
    Flag cancelled;
  };

  void emit(const Event& event) const {
    if (listener_) listener_(event);
  }

  void stop(Lane lane) {
    if (const Flag& flag = lanes_[static_cast<std::size_t>(lane)].cancelled) *flag = true;
  }

  History& history() { return document_.project.history; }

  EditedFrom from_current() const { return {workspace_, current_.design, direction_, at_rest_.value}; }

  /// Forgets what is known of the design that was current.
  void forget_advice() {
    stop(Lane::advice);
    review_.reset();
    suggestions_.clear();
    refused_.clear();
    suggested_ = false;
    wanted_range_.reset();
    range_.reset();
    dragged_.reset();
    drag_edit_.reset();
    dragging_ = false;
  }

  /// Measures the current node.
  void load_node() {
    const HistoryNode& node = history().nodes[static_cast<std::size_t>(history().current)];
    std::shared_ptr<const Design> design =
        designs_.of(workspace_->space(), document_.project.history, history().current);
    direction_ = Direction(node.direction);
    at_rest_ = workspace_->checker().rest_shape().measure(direction_);
    current_ = workspace_->measured(std::move(design), direction_, at_rest_.value);
    forget_advice();
  }

  void announce_node() {
    save();
    emit(Changed{Change::design});
    emit(Changed{Change::review});
    emit(Changed{Change::suggestions});
    emit(Changed{Change::range});
    emit(Changed{Change::tree});
  }

  void save() const {
    if (options_.autosave.empty()) return;
    try {
      write_file_atomically(options_.autosave, document_text(document_));
    } catch (const Error& error) {
      emit(Failed{error.what()});
    }
  }

  /// Makes a node current, as a step that Undo reverts.
  void visit(int node) {
    history().current = node;
    document_.visited.resize(document_.place + 1);
    document_.visited.push_back(node);
    document_.place = document_.visited.size() - 1;
    load_node();
    announce_node();
  }

  void go_to_place(std::size_t place) {
    document_.place = place;
    history().current = document_.visited[place];
    load_node();
    announce_node();
  }

  /// Adds a node with a design that was measured along its direction.
  void add_node(HistoryNode node, std::shared_ptr<const Design> design) {
    history() = apply(std::move(history()), std::move(node));
    designs_.remember(history().current, std::move(design));
    visit(history().current);
  }

  HistoryNode node_with(std::vector<Edit> edits, std::string name) const {
    HistoryNode node;
    node.edits = std::move(edits);
    node.constraints = workspace_->constraints(direction_);
    node.name = std::move(name);
    node.direction = direction_.vector();
    return node;
  }

  const std::vector<std::string>& part_names() const { return workspace_->space().rest().shape.part_names; }

  // Commands.

  void run(const ApplySuggestion& command) {
    expect_row(command.number, suggestions_.size(), "suggestion");
    const OfferedEdit offered = suggestions_[static_cast<std::size_t>(command.number)];
    const ContactEdit& edit = offered.suggestion.edit;
    HistoryNode node =
        node_with({edit.edit}, name_of(offered.explanation, describe(edit.reason, part_names())));
    node.stackability = offered.suggestion.measured.value;
    node.energy = offered.suggestion.energy.value;
    add_node(std::move(node), offered.design);
  }

  void run(const Drag& command) {
    if (!range_runs_) stop(Lane::advice);
    const double known = dragged_ && drag_edit_ ? known_share(*drag_edit_, command.edit) : 0;
    LargestEdit largest = largest_part(from_current(), command.edit, known);
    dragging_ = true;
    drag_edit_ = scaled(command.edit, largest.amount);
    dragged_ = std::move(largest.made);
    emit(Changed{Change::design});
    if (largest.obstacle) emit(Refused{*largest.obstacle});
  }

  /// Returns the share of `wanted` that `made` is, where both are moves of one handle along one line.
  static double known_share(const Edit& made, const Edit& wanted) {
    const auto* a = std::get_if<Move>(&made.operation);
    const auto* b = std::get_if<Move>(&wanted.operation);
    if (!a || !b || made.handle != wanted.handle || !(b->by.squaredNorm() > 0)) return 0;
    const double share = a->by.dot(b->by) / b->by.squaredNorm();
    return a->by.cross(b->by).norm() <= same_line_sine * a->by.norm() * b->by.norm() ? share : 0;
  }

  void run(const EndDrag& command) {
    if (!dragging_) return;
    const std::optional<MeasuredDesign> made = std::exchange(dragged_, std::nullopt);
    const std::optional<Edit> edit = std::exchange(drag_edit_, std::nullopt);
    dragging_ = false;
    if (!command.keep || !made || !edit || made->design->shape.vertices == current_.design->shape.vertices) {
      emit(Changed{Change::design});
      return;
    }
    const Explanation words = explain(rebase(workspace_->space().rest(), *current_.design),
                                      made->design->shape, {.edits = {*edit}, .reasons = {}});
    HistoryNode node = node_with({*edit}, name_of(words, describe(*edit, part_names())));
    node.stackability = made->assessment.measured.value;
    node.energy = made->energy.value;
    add_node(std::move(node), made->design);
  }

  void run(const FindRange& command) {
    validate(command.edit, workspace_->space().rest().structure.diagonal);
    stop(Lane::advice);
    wanted_range_ = command.edit;
    range_.reset();
    emit(Changed{Change::range});
  }

  void run(const RollBack& command) {
    expect_row(command.node, history().nodes.size(), "node");
    if (command.node != history().current) visit(command.node);
  }

  void run(const Undo& /*command*/) {
    if (document_.place > 0) return go_to_place(document_.place - 1);
    if (earlier_.empty()) return;
    Document earlier = std::move(earlier_.back());
    earlier_.pop_back();
    load(std::move(earlier));
  }

  void run(const Redo& /*command*/) {
    if (document_.place + 1 < document_.visited.size()) go_to_place(document_.place + 1);
  }

  /// Replaces the requirements.
  void require(const Requirements& requirements) {
    workspace_ = std::make_shared<const Workspace>(*workspace_, requirements);
    document_.requirements = requirements;
    stop(Lane::automatic);
    finding_wanted_ = false;
    load_node();
    emit(Changed{Change::wishes});
    announce_node();
  }

  void run(const SetTarget& command) {
    Requirements requirements = document_.requirements;
    requirements.target = command.target;
    require(requirements);
  }

  void run(const SetLimit& command) {
    Requirements requirements = document_.requirements;
    if (!requirements.quality) requirements.quality.emplace();
    if (command.limit)
      (*requirements.quality)[command.measure] = *command.limit;
    else
      requirements.quality->relax(command.measure);
    require(requirements);
  }

  void run(const KeepParts& command) {
    Requirements requirements = document_.requirements;
    requirements.kept_parts = command.parts;
    require(requirements);
  }

  void run(const SetDirection& command) {
    const Direction direction(command.direction);
    const MeasuredDesign measured = workspace_->measured(
        current_.design, direction, workspace_->checker().rest_shape().measure(direction).value);
    HistoryNode node = node_with({}, "stacked " + direction_text(command.direction));
    node.constraints = workspace_->constraints(direction);
    node.direction = command.direction;
    node.stackability = measured.assessment.measured.value;
    node.energy = measured.energy.value;
    add_node(std::move(node), current_.design);
  }

  void run(const FindDesigns& /*command*/) {
    stop(Lane::automatic);
    found_ = {};
    found_.target = document_.requirements.target;
    found_.running = finding_wanted_ = true;
    emit(Changed{Change::found});
    emit(Progress{Work::designs, 0});
  }

  void run(const StopFinding& /*command*/) {
    stop(Lane::automatic);
    finding_wanted_ = found_.running = false;
    emit(Changed{Change::found});
    emit(Progress{Work::designs, 1});
  }

  void run(const TakeDesign& command) {
    expect_row(command.number, found_.designs.size(), "design");
    const auto row = static_cast<std::size_t>(command.number);
    const Candidate candidate = found_.designs[row];
    HistoryNode node =
        node_with(candidate.design.edits,
                  name_of(found_.explanations[row], "found design " + std::to_string(command.number + 1)));
    node.constraints = workspace_->constraints(Direction(candidate.direction));
    node.direction = candidate.direction;
    node.stackability = candidate.measured.value;
    node.energy = candidate.energy.value;
    const DeformationResult again = workspace_->space().deformed(node.edits, node.constraints);
    if (again.refusal) throw UsageError(describe(*again.refusal, workspace_->space().rest().structure));
    history() = roll_back(std::move(history()), 0);
    add_node(std::move(node), std::make_shared<const Design>(again.design));
  }

  void run(const AcceptRemedy& command) {
    const std::vector<Remedy> none;
    const std::vector<Remedy>& remedies = found_.diagnosis ? found_.diagnosis->remedies : none;
    expect_row(command.number, remedies.size(), "offer");
    const Remedy remedy = remedies[static_cast<std::size_t>(command.number)];
    Requirements requirements = document_.requirements;
    switch (remedy.kind) {
      case Remedy::Kind::other_direction:
        return run(SetDirection{remedy.direction});
      case Remedy::Kind::free_part:
        std::erase_if(requirements.kept_parts, [&](int part) {
          return std::find(remedy.parts.begin(), remedy.parts.end(), part) != remedy.parts.end();
        });
        break;
      case Remedy::Kind::remove_part:
      case Remedy::Kind::take_apart:
        throw UsageError("parts cannot be left out here; `improve --remove` does it");
      case Remedy::Kind::relax_height:
        requirements.keep_height = false;
        break;
      case Remedy::Kind::relax_box:
        requirements.box_tolerance.reset();
        break;
      case Remedy::Kind::relax_quality:
        if (requirements.quality) requirements.quality->relax(remedy.measure);
        break;
    }
    require(requirements);
  }

  /// Starts anew with a document.
  void load(Document document) {
    auto workspace = std::make_shared<const Workspace>(document.project, document.requirements);
    stop(Lane::automatic);
    found_ = {};
    finding_wanted_ = false;
    designs_ = {};
    workspace_ = std::move(workspace);
    document_ = std::move(document);
    load_node();
    emit(Changed{Change::structure});
    emit(Changed{Change::wishes});
    emit(Changed{Change::found});
    announce_node();
  }

  /// Goes on with another structure of the same shape and the same wishes.
  void replace_structure(StructuredShape structured) {
    Document fresh = new_document(std::move(structured), document_.requirements.measure);
    const HistoryNode& old = document_.project.history.nodes.front();
    HistoryNode& root = fresh.project.history.nodes.front();
    root.direction = old.direction;
    root.stackability = old.stackability;
    fresh.source = document_.source;
    const Requirements& wishes = document_.requirements;
    fresh.requirements.target = wishes.target;
    fresh.requirements.keep_height = wishes.keep_height;
    fresh.requirements.quality = wishes.quality;
    Document before = document_;
    load(std::move(fresh));
    earlier_.push_back(std::move(before));
    emit(Changed{Change::tree});
  }

  /// Analyses a shape with its parts as they are. `forced`: kinds of primitives, by part name.
  void analyse(const Shape& shape, const std::map<std::string, PrimitiveKind>& forced) {
    AnalysisOptions options;
    options.segmentation.method = SegmentationMethod::given;
    options.max_parts = DeformationLimits().max_parts;
    options.kinds = forced;
    replace_structure(analyse_structure(shape, options));
  }

  void run(const Segment& command) {
    analyse(segment_by_strokes(workspace_->space().rest().shape, command.strokes), {});
  }

  void run(const SetKind& command) {
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

  void run(const RemoveRelations& command) {
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

  // Jobs.

  /// Returns a result that is dropped once the job was cancelled.
  template <class Function>
  static EditingSession::Result unless(const Flag& cancelled, Function function) {
    return [cancelled, function = std::move(function)] {
      if (!*cancelled) function();
    };
  }

  std::function<void(const Flag&, const Deliver&)> review_work() {
    return [this, from = from_current(), contacts_of = ContactEditOptions().contacts](
               const Flag& cancelled, const Deliver& deliver) {
      Review review;
      const RequirementChecker& checker = from.workspace->checker();
      review.contacts = situation(checker, *from.design, from.direction).contacts;
      const StructuredShape& rest = from.workspace->space().rest();
      review.explanation = explain(rest, from.design->shape, {.edits = from.design->edits, .reasons = {}});
      review.assessment = checker.check(*from.design, from.direction);
      deliver(unless(cancelled, [this, review] {
        review_ = review;
        emit(Changed{Change::review});
      }));
    };
  }

  std::function<void(const Flag&, const Deliver&)> suggestion_work() {
    return [this, from = from_current(), now = current_.assessment.measured.value, options = options_](
               const Flag& cancelled, const Deliver& deliver) {
      const auto offer = [&](const std::vector<Suggestion>& list) {
        auto offered = std::make_shared<const std::vector<OfferedEdit>>(offers(from, now, list, options));
        deliver(unless(cancelled, [this, offered] {
          suggestions_ = *offered;
          emit(Changed{Change::suggestions});
        }));
      };
      SuggestionOptions how;
      how.alpha = options.alpha;
      how.edits.family = EditFamily::smooth;
      how.only_helpful = true;
      std::size_t shown = 0;
      how.found = [&](const std::vector<Suggestion>& list) {
        const std::size_t possible = possible_of(list);
        if (possible > shown) offer(list);
        shown = possible;
      };
      how.cancelled = [&] { return cancelled->load(); };
      how.progress = [&](double fraction) {
        deliver(unless(cancelled, [this, fraction] { emit(Progress{Work::suggestions, fraction}); }));
      };
      const std::vector<Suggestion> list =
          stackabilization::suggestions(from.workspace->checker(), *from.design, from.direction, how);
      std::vector<ObstacleCount> refusals = refusals_of(list, from.workspace->space().rest().structure);
      deliver(unless(cancelled, [this, refusals] {
        refused_ = refusals;
        suggested_ = true;
        emit(Changed{Change::suggestions});
        emit(Progress{Work::suggestions, 1});
      }));
    };
  }

  static std::size_t possible_of(const std::vector<Suggestion>& list) {
    return static_cast<std::size_t>(
        std::count_if(list.begin(), list.end(), [](const Suggestion& one) { return !one.refusal; }));
  }

  static std::vector<ObstacleCount> refusals_of(const std::vector<Suggestion>& list,
                                                const Structure& structure) {
    std::vector<ObstacleCount> counts;
    for (const Suggestion& one : list) {
      if (!one.refusal) continue;
      const Obstacle obstacle = without_amounts(*one.refusal);
      const auto known = std::find_if(counts.begin(), counts.end(),
                                      [&](const ObstacleCount& count) { return count.obstacle == obstacle; });
      if (known == counts.end())
        counts.push_back({obstacle, 1});
      else
        ++known->count;
    }
    sort_by_count(counts, structure);
    return counts;
  }

  static std::vector<OfferedEdit> offers(const EditedFrom& from, double now,
                                         const std::vector<Suggestion>& list, const SessionOptions& options) {
    const DeformationModel& space = from.workspace->space();
    const StructuredShape before = rebase(space.rest(), *from.design);
    std::vector<OfferedEdit> result;
    for (const Suggestion& one : list) {
      if (one.refusal || result.size() == static_cast<std::size_t>(options.max_suggestions)) break;
      OfferedEdit offered;
      offered.suggestion = one;
      offered.design = std::make_shared<const Design>(
          space.edited(*from.design, one.edit.edit, from.workspace->constraints(from.direction)).design);
      offered.explanation =
          explain(before, offered.design->shape, {.edits = {one.edit.edit}, .reasons = {one.edit.reason}});
      offered.gain = one.measured.value - now;
      offered.change = shape_change(space.rest().shape, offered.design->shape);
      result.push_back(std::move(offered));
    }
    return result;
  }

  std::function<void(const Flag&, const Deliver&)> range_work() {
    return [this, from = from_current(), edit = *std::exchange(wanted_range_, std::nullopt)](
               const Flag& cancelled, const Deliver& deliver) {
      HandleRange range = handle_range(from, edit, [&] { return cancelled->load(); });
      deliver(unless(cancelled, [this, range] {
        range_ = range;
        emit(Changed{Change::range});
      }));
    };
  }

  std::function<void(const Flag&, const Deliver&)> automatic_work() {
    if (!std::exchange(finding_wanted_, false)) return nullptr;
    return [this, workspace = workspace_, direction = direction_, options = options_](
               const Flag& cancelled, const Deliver& deliver) {
      std::vector<Candidate> starts;
      for (const double share : effort_shares) {
        const bool last = share == effort_shares.back();
        ImprovementOptions how = smooth_improvement();
        how.effort = share * options.effort;
        how.search.alpha = options.alpha;
        how.search.solutions = 3;
        how.search.directions = {direction.vector()};
        how.starts = starts;
        how.search.cancelled = [&] { return cancelled->load(); };
        how.search.progress = [&](const ImprovementProgress& progress) {
          const double done = last ? effort_shares.front() + (1 - effort_shares.front()) * progress.work
                                   : effort_shares.front() * progress.work;
          deliver(unless(cancelled, [this, done] { emit(Progress{Work::designs, std::min(done, 1.0)}); }));
        };
        const Improvement improvement = improve(workspace->checker(), how);
        starts = improvement.solutions;
        deliver_found(*workspace, improvement, cancelled, deliver);
      }
      deliver(unless(cancelled, [this] {
        found_.running = false;
        emit(Changed{Change::found});
        emit(Progress{Work::designs, 1});
      }));
    };
  }

  void deliver_found(const Workspace& workspace, const Improvement& improvement, const Flag& cancelled,
                     const Deliver& deliver) {
    FoundDesigns found;
    found.target = workspace.checker().requirements().target;
    found.designs = improvement.solutions;
    found.diagnosis = improvement.diagnosis;
    found.running = true;
    for (const Candidate& one : found.designs) {
      found.explanations.push_back(explain(workspace.space().rest(), one.design.shape,
                                           {.edits = one.design.edits, .reasons = one.reasons}));
      found.changes.push_back(shape_change(workspace.space().rest().shape, one.design.shape));
    }
    deliver(unless(cancelled, [this, found] {
      found_ = found;
      emit(Changed{Change::found});
    }));
  }

  std::array<LaneState, 2> lanes_;
};

EditingSession::EditingSession(Document document, SessionOptions options, Listener listener)
    : implementation_(
          std::make_unique<Implementation>(std::move(document), std::move(options), std::move(listener))) {}

EditingSession::~EditingSession() = default;

void EditingSession::execute(const Command& command) {
  implementation_->execute(command);
}

std::optional<EditingSession::Job> EditingSession::next_job(Lane lane) {
  return implementation_->next_job(lane);
}

void EditingSession::cancel() {
  implementation_->cancel();
}

const Document& EditingSession::document() const {
  return implementation_->document_;
}

const DeformationModel& EditingSession::space() const {
  return implementation_->workspace_->space();
}

const RequirementChecker& EditingSession::checker() const {
  return implementation_->workspace_->checker();
}

const Direction& EditingSession::direction() const {
  return implementation_->direction_;
}

const Stackability& EditingSession::at_rest() const {
  return implementation_->at_rest_;
}

const MeasuredDesign& EditingSession::current() const {
  return implementation_->current_;
}

const MeasuredDesign& EditingSession::shown() const {
  return implementation_->dragged_ ? *implementation_->dragged_ : implementation_->current_;
}

const std::optional<Edit>& EditingSession::drag() const {
  return implementation_->drag_edit_;
}

bool EditingSession::dragging() const {
  return implementation_->dragging_;
}

bool EditingSession::can_undo() const {
  return implementation_->document_.place > 0 || !implementation_->earlier_.empty();
}

bool EditingSession::can_redo() const {
  return implementation_->document_.place + 1 < implementation_->document_.visited.size();
}

const std::optional<Review>& EditingSession::review() const {
  return implementation_->review_;
}

const std::vector<OfferedEdit>& EditingSession::suggestions() const {
  return implementation_->suggestions_;
}

bool EditingSession::suggestions_complete() const {
  return implementation_->suggested_;
}

const std::vector<ObstacleCount>& EditingSession::refused() const {
  return implementation_->refused_;
}

const std::optional<HandleRange>& EditingSession::range() const {
  return implementation_->range_;
}

const FoundDesigns& EditingSession::found() const {
  return implementation_->found_;
}

std::shared_ptr<const Design> EditingSession::design_of(int node) const {
  const History& history = implementation_->document_.project.history;
  expect_row(node, history.nodes.size(), "node");
  return implementation_->designs_.of(implementation_->workspace_->space(), history, node);
}

}  // namespace stackabilization::editing
