#include <algorithm>
#include <map>

#include "sessions.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::editing;
using sessions::Observed;

namespace {

/// The row of the first remedy of a kind.
int row_of(const std::vector<Remedy>& remedies, Remedy::Kind kind) {
  const auto found = std::find_if(remedies.begin(), remedies.end(),
                                  [&](const Remedy& remedy) { return remedy.kind == kind; });
  REQUIRE(found != remedies.end());
  return static_cast<int>(found - remedies.begin());
}

/// A session whose search for a target that is out of reach has ended.
struct SearchInVain : Observed {
  SearchInVain(Document document, double target, double effort = 0.1)
      : Observed(aimed(std::move(document), target), search_of(effort)) {
    session.execute(FindDesigns{});
    work(Lane::automatic);
    REQUIRE(session.found().designs.empty());
    REQUIRE(session.found().diagnosis);
  }

  static Document aimed(Document document, double target) {
    document.requirements.target = target;
    return document;
  }
  static SessionOptions search_of(double effort) {
    SessionOptions options;
    options.effort = effort;
    return options;
  }
};

/// Begins a search, and returns its job.
EditingSession::Job begun(EditingSession& session, const FindDesigns& command = {}) {
  session.execute(command);
  const auto job = session.next_job(Lane::automatic);
  REQUIRE(job);
  return *job;
}

}  // namespace

TEST_CASE("designs that the automatic search finds reach the target, and one is taken on") {
  const StructuredShape table =
      analyse_structure(read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/table.obj"));
  SessionOptions options;
  options.effort = 0.2;
  Observed observed(new_document(table), options);
  EditingSession& session = observed.session;
  session.execute(FindDesigns{});
  CHECK(session.found().running);
  observed.work(Lane::automatic);
  CHECK(!session.found().running);
  const FoundDesigns& found = session.found();
  REQUIRE(!found.designs.empty());
  for (const FoundDesign& one : found.designs) {
    CHECK(session.checker().check(one.candidate.design, Direction(one.candidate.direction)).passed());
    CHECK(one.candidate.measured.value >= found.target);
  }
  const Points vertices = found.designs[0].candidate.design.shape.vertices;
  session.execute(TakeDesign{found.designs[0].number});
  CHECK((session.current().design->shape.vertices - vertices).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(session.document().project.history.nodes[1].parent == 0);
  CHECK_THROWS_AS(session.execute(TakeDesign{99}), UsageError);
}

TEST_CASE("designs arrive while the search goes on, least change first") {
  const StructuredShape table =
      analyse_structure(read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/table.obj"));
  SessionOptions options;
  options.effort = 0.2;
  Observed observed(new_document(table), options);
  EditingSession& session = observed.session;
  const EditingSession::Job job = begun(session);
  const double first_search = 0.1;  // share of the first of two searches
  std::map<int, Points> numbered;
  double done = 0, done_at_first_design = -1;
  bool same_search_goes_on = false;
  job([&](const EditingSession::Result& result) {
    observed.events.clear();
    result();
    for (const Progress& progress : observed.all<Progress>()) done = progress.fraction;
    const FoundDesigns& found = session.found();
    if (done_at_first_design < 0 && !found.designs.empty()) done_at_first_design = done;
    const double since = done_at_first_design;
    if (since >= 0 && done > since && done < 1 && (since > first_search || done <= first_search))
      same_search_goes_on = true;
    double before = 0;
    for (const FoundDesign& found_design : found.designs) {
      const Candidate& one = found_design.candidate;
      CHECK(session.checker().check(one.design, Direction(one.direction)).passed());
      const double size = size_of(ChangeMeasure::both, one, session.space().rest().shape);
      CHECK(size >= before);
      before = size;
      // A number is that of one design, however the list changes.
      const Points& vertices = one.design.shape.vertices;
      CHECK(numbered.emplace(found_design.number, vertices).first->second == vertices);
    }
  });
  CHECK(same_search_goes_on);
  CHECK(!session.found().running);
}

TEST_CASE("a front arrives design by design, whatever the target, and one is taken on") {
  SessionOptions options;
  options.effort = 0.3;
  Document document = sessions::table_document();
  document.requirements.length_limit = {5, 100};  // out of account, as the target is
  Observed observed(std::move(document), options);
  EditingSession& session = observed.session;
  const EditingSession::Job job = begun(session, {true});
  std::vector<std::size_t> counts;
  double done = 0;
  job([&](const EditingSession::Result& result) {
    observed.events.clear();
    result();
    for (const Progress& progress : observed.all<Progress>()) {
      CHECK(progress.fraction >= done);
      done = progress.fraction;
    }
    const FoundDesigns& found = session.found();
    CHECK(found.front);
    CHECK(found.at_rest == session.at_rest().value);
    if (counts.empty() || counts.back() != found.designs.size()) counts.push_back(found.designs.size());
    double change = 0, s = found.at_rest;
    for (const FoundDesign& one : found.designs) {
      const double size = size_of(ChangeMeasure::both, one.candidate, session.space().rest().shape);
      CHECK(size > change);
      CHECK(one.candidate.measured.value > s);
      change = size;
      s = one.candidate.measured.value;
      const Assessment assessment =
          session.checker().check(one.candidate.design, Direction(one.candidate.direction));
      for (const Check& check : assessment.checks) CHECK((check.passed || check.is_of_target()));
    }
  });
  CHECK(done == 1);
  CHECK(!session.found().running);
  CHECK(counts.size() > 2);
  const std::vector<FoundDesign> designs = session.found().designs;
  REQUIRE(designs.size() > 2);
  session.execute(TakeDesign{designs[1].number});
  CHECK(session.current().assessment.measured.value == Approx(designs[1].candidate.measured.value));
}

TEST_CASE("a target out of reach is diagnosed, and an offer is accepted") {
  Document document = sessions::table_document();
  document.requirements.quality.emplace()[QualityMeasure::size] = 0.9995;  // legs that lean get longer
  SearchInVain in_vain(std::move(document), 0.5, 1);
  EditingSession& session = in_vain.session;
  const std::vector<Remedy> remedies = session.found().diagnosis->remedies;
  const int row = row_of(remedies, Remedy::Kind::relax_quality);
  session.execute(AcceptRemedy{row});
  CHECK(
      !session.checker().requirements().quality->is_limited(remedies[static_cast<std::size_t>(row)].measure));
}

TEST_CASE("an object that is taken apart goes on as its largest piece, until Undo") {
  SearchInVain in_vain(new_document(structures::mug()), 0.99);
  EditingSession& session = in_vain.session;
  const std::vector<std::string> names = session.space().rest().shape.part_names;
  session.execute(AcceptRemedy{row_of(session.found().diagnosis->remedies, Remedy::Kind::take_apart)});
  CHECK(session.space().rest().shape.part_names == std::vector<std::string>{names[0]});
  session.execute(Undo{});
  CHECK(session.space().rest().shape.part_names == names);
}

TEST_CASE("a search for what is no longer wanted ends") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const EditingSession::Job job = begun(session);
  observed.events.clear();
  session.execute(SetTarget{0.3});
  CHECK(!session.found().running);
  const std::vector<Changed> changes = observed.all<Changed>();
  CHECK(std::any_of(changes.begin(), changes.end(),
                    [](const Changed& change) { return change.what == Change::found; }));
  REQUIRE(!observed.all<Progress>().empty());
  CHECK(observed.all<Progress>().back().fraction == 1);
  job([](const EditingSession::Result& result) { result(); });
  CHECK(session.found().designs.empty());
  CHECK(!session.next_job(Lane::automatic));
}

TEST_CASE("a search that is stopped keeps nothing running") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const EditingSession::Job job = begun(session);
  session.execute(StopFinding{});
  std::vector<EditingSession::Result> results;
  job([&](EditingSession::Result result) { results.push_back(std::move(result)); });
  for (const EditingSession::Result& result : results) result();
  CHECK(session.found().designs.empty());
  CHECK(!session.found().running);
  CHECK(!session.next_job(Lane::automatic));
}
