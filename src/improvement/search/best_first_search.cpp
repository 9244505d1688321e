#include "improvement/search/best_first_search.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

namespace stackabilization::detail {

namespace {

/// Largest number of candidates reported when the target was not reached.
constexpr int max_nearest = 8;
/// So many are checked until one is acceptable; fewer after a deadline, and none of a cancelled search.
constexpr int max_checked = 40;

/// Cost of a search of the cone, in edits.
constexpr std::int64_t cone_trials = 8;

/// Least time between two saves, seconds, and the largest share of the time for saving.
constexpr double save_every = 1;
constexpr double save_share = 0.05;

double share_of(std::int64_t done, std::int64_t allowed) {
  return allowed > 0 ? static_cast<double>(done) / static_cast<double>(allowed) : 1;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

BestFirstSearch::BestFirstSearch(const RequirementChecker& checker, const BestFirstOptions& options,
                                 SearchState state)
    : tools_(checker, options),
      state_(std::move(state)),
      interruption_(options),
      designs_(checker, state_.tree),
      cone_(checker, options.cone_degrees),
      distinct_(checker.space().rest()) {
  if (state_.tree.nodes().empty()) add_roots();
  for (int id = 0; id < state_.tree.count(); ++id) {
    notice(state_.tree.node(id));
    if (state_.tree.node(id).state == NodeState::solution) solutions_.emplace_back(id, designs_.of(id));
  }
}

void BestFirstSearch::add_roots() {
  const Design rest = checker().space().at_rest();
  for (std::size_t queue = 0; queue < options().directions.size(); ++queue) {
    SearchNode root;
    root.queue = static_cast<int>(queue);
    root.direction = options().directions[queue];
    root.measured = checker().rest_shape().measure(Direction(root.direction));
    root.energy = tools_.energy(rest, root.measured);
    root.key = tools_.keys.key(rest);
    state_.tree.add(root);
    ++state_.evaluated;
  }
}

void BestFirstSearch::notice(const SearchNode& node) {
  best_stackability_ = std::max(best_stackability_, node.measured.value);
  best_energy_ = std::min(best_energy_, node.energy.value);
}

BestFirstResult BestFirstSearch::run() {
  save();
  std::optional<SearchEnd> ended = end();
  while (!ended) {
    ended = step(*state_.tree.next());
    if (ended) break;
    ended = end();
    if (options().progress) options().progress(progress());
    if (seconds_since(last_save_) >= std::max(save_every, save_seconds_ / save_share)) save();
  }
  save();
  return result(*ended);
}

std::optional<SearchEnd> BestFirstSearch::end() {
  if (solutions_.size() >= static_cast<std::size_t>(options().solutions)) return SearchEnd::solved;
  if (!state_.tree.next()) return SearchEnd::exhausted;
  if (state_.expanded >= options().expansions) return SearchEnd::expansion_limit;
  if (interruption_.now()) return interruption_.why();
  return std::nullopt;
}

std::optional<SearchEnd> BestFirstSearch::step(int id) {
  const SearchNode node = state_.tree.node(id);
  const std::shared_ptr<const Design> design = designs_.of(id);
  Stackability measured = node.measured;
  if (!checker().meets_target(measured))
    if (const auto better = cone_.better(design->shape, measured)) measured = *better;

  const Verdict verdict = this->verdict(*design, measured);
  std::vector<SuccessorNode> made;
  if (!verdict.state) {
    const ExpandedNode from{*design, measured.direction, node.queue};
    std::vector<ContactEdit> edits = suggested_edits(tools_, from);
    const auto trials = static_cast<std::int64_t>(edits.size()) + turning_trials();
    if (trials > options().trials - state_.trials) return SearchEnd::trial_limit;
    made = successors(tools_, from, std::move(edits), state_.tree, interruption_);
    if (interruption_.why()) return interruption_.why();
    state_.trials += trials;
    ++state_.expanded;
  }
  state_.tree.settle(id, verdict.state.value_or(NodeState::expanded));
  state_.tree.turn_to(id, measured, tools_.energy(*design, measured));
  notice(state_.tree.node(id));
  if (verdict.state == NodeState::solution) solutions_.emplace_back(id, design);
  for (const Check& check : verdict.broken) ++state_.refusals[without_amounts(Obstacle(check))];
  add_successors(id, made);
  return std::nullopt;
}

std::int64_t BestFirstSearch::turning_trials() const {
  return options().cone_degrees > 0 ? cone_trials : 0;
}

BestFirstSearch::Verdict BestFirstSearch::verdict(const Design& design, const Stackability& measured) const {
  if (!checker().meets_target(measured)) return {};
  for (const auto& solution : solutions_)
    if (!distinct_.differ(design, *solution.second)) return {NodeState::repeated, {}};
  const Assessment assessment = checker().check(design, Direction(measured.direction));
  if (assessment.passed()) return {NodeState::solution, {}};
  Verdict verdict;
  for (const Check& check : assessment.checks)
    if (!check.passed) verdict.broken.push_back(check);
  return verdict;
}

void BestFirstSearch::add_successors(int parent, const std::vector<SuccessorNode>& made) {
  const SearchNode from = state_.tree.node(parent);
  std::vector<std::pair<int, const SuccessorNode*>> added;
  for (const SuccessorNode& successor : made) {
    if (successor.refusal) {
      ++state_.refusals[without_amounts(*successor.refusal)];
      continue;
    }
    if (!successor.known) ++state_.evaluated;
    if (state_.tree.knows(from.queue, successor.key)) continue;
    SearchNode node;
    node.parent = parent;
    node.queue = from.queue;
    node.edit = successor.suggestion.edit;
    node.reason = successor.suggestion.reason;
    node.direction = from.direction;
    node.measured = successor.measured;
    node.energy = successor.energy;
    node.key = successor.key;
    notice(node);
    added.emplace_back(state_.tree.add(std::move(node)), &successor);
  }
  // Add those of least E last: they are expanded first and should leave the cache last.
  std::sort(added.begin(), added.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second->energy.value, a.first) > std::pair(b.second->energy.value, b.first);
  });
  for (const auto& [id, successor] : added) designs_.keep(id, successor->design);
}

ImprovementProgress BestFirstSearch::progress() const {
  ImprovementProgress now;
  now.best_stackability = best_stackability_;
  now.best_energy = best_energy_;
  now.expanded = state_.expanded;
  now.evaluated = state_.evaluated;
  now.trials = state_.trials;
  now.queued = state_.tree.queued();
  now.solutions = static_cast<int>(solutions_.size());
  now.work =
      std::max(share_of(state_.expanded, options().expansions), share_of(state_.trials, options().trials));
  now.seconds_left = std::max(0.0, options().seconds - interruption_.seconds());
  return now;
}

void BestFirstSearch::save() {
  if (!options().save) return;
  const auto start = std::chrono::steady_clock::now();
  options().save(state_text());
  save_seconds_ = seconds_since(start);
  last_save_ = std::chrono::steady_clock::now();
}

Candidate BestFirstSearch::candidate(int id) {
  const SearchNode& node = state_.tree.node(id);
  Candidate candidate;
  candidate.design = *designs_.of(id);
  candidate.direction = node.direction;
  candidate.measured = node.measured;
  candidate.energy = node.energy;
  for (const int step : state_.tree.path(id)) candidate.reasons.push_back(state_.tree.node(step).reason);
  return candidate;
}

/// With limits of quality the best acceptable candidate is there too, as the last one where it is not among
/// the first or edits the same handles as one of these.
std::vector<Candidate> BestFirstSearch::nearest() {
  std::vector<int> order;
  for (int id = 0; id < state_.tree.count(); ++id) {
    const NodeState state = state_.tree.node(id).state;
    if (state == NodeState::queued || state == NodeState::expanded) order.push_back(id);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return state_.tree.node(a).measured.value > state_.tree.node(b).measured.value;
  });
  std::vector<Candidate> nearest;
  std::vector<std::vector<EditSignature>> shown;
  bool acceptable = !checker().requirements().quality;
  interruption_.now();
  const std::optional<SearchEnd> interrupted = interruption_.why();
  const int to_check = interrupted == SearchEnd::cancelled ? 0 : interrupted ? max_nearest : max_checked;
  int checked = 0;
  for (const int id : order) {
    const bool looking = !acceptable && checked < to_check;
    if (std::ssize(nearest) >= max_nearest && !looking) break;
    std::vector<Edit> edits;
    for (const int step : state_.tree.path(id)) edits.push_back(state_.tree.node(step).edit);
    std::vector<EditSignature> signatures = distinct_.signatures(edits);
    const bool is_new = std::find(shown.begin(), shown.end(), signatures) == shown.end();
    if (!is_new && !looking) continue;
    shown.push_back(std::move(signatures));
    Candidate near = candidate(id);
    const bool passes = looking && !checker().obstacle(near.design, Direction(near.direction));
    checked += looking ? 1 : 0;
    acceptable |= passes;
    if (passes || (is_new && std::ssize(nearest) < max_nearest)) nearest.push_back(std::move(near));
  }
  return nearest;
}

std::vector<ObstacleCount> BestFirstSearch::refusals() const {
  std::vector<ObstacleCount> counts;
  for (const auto& [obstacle, count] : state_.refusals) counts.push_back({obstacle, count});
  sort_by_count(counts, checker().space().rest().structure);
  return counts;
}

BestFirstResult BestFirstSearch::result(SearchEnd end) {
  BestFirstResult result;
  result.end = end;
  for (const auto& solution : solutions_) result.solutions.push_back(candidate(solution.first));
  std::stable_sort(result.solutions.begin(), result.solutions.end(),
                   [](const Candidate& a, const Candidate& b) { return a.energy.value < b.energy.value; });
  result.nearest = nearest();
  result.refusals = refusals();
  result.progress = progress();
  return result;
}

}  // namespace stackabilization::detail
