#include "apps/editor/state_json.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "apps/common/design_json.h"
#include "apps/common/edit_grammar.h"
#include "apps/common/explanation_report.h"
#include "apps/common/text.h"
#include "apps/improve/improve_report.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::apps {

namespace {

using editing::EditingSession;

constexpr double alpha_shown = 0.2;  ///< of energies, that of SessionOptions

Json points_json(const Points& points) {
  Json list = Json::array();
  for (Eigen::Index row = 0; row < points.rows(); ++row)
    list.push_back(to_json(Eigen::Vector3d(points.row(row).transpose())));
  return list;
}

Json primitive_json(const Primitive& primitive) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive))
    return {{"kind", "cuboid"}, {"points", points_json(cuboid->corners)}};
  const auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  Json radii = Json::array();
  for (const double radius : cylinder.radii) radii.push_back(radius);
  return {{"kind", "cylinder"},
          {"points", points_json(cylinder.centres)},
          {"radii", radii},
          {"closed", cylinder.closed}};
}

Json measured_json(const Stackability& measured) {
  return {{"stackability", measured.value}, {"f_max", measured.f_max}, {"height", measured.extent}};
}

/// What a check found, and its limit: "size 0.79 of rest, at least 0.8 ('leg')".
std::string limit_words(const Check& check, const Structure& rest) {
  if (check.kind != CheckKind::quality) return check_text(check, rest);
  const std::string note = note_of(check, rest);
  const double shown = std::abs(check.value) < tolerance::relative ? 0 : check.value;
  return name_of(check.measure) + " " + rounded(shown) + " " + unit_of(check) + ", " +
         (has_lower_limit(check.measure) ? "at least " : "at most ") + rounded(check.demanded) +
         (note.empty() ? "" : " (" + note + ")");
}

/// Checks that a person may want to see, with the share of the limit that they use.
Json checks_json(const std::vector<Check>& checks, const Structure& rest, const QualityLimits* limits) {
  Json list = Json::array();
  for (const Check& check : checks) {
    Json json = {
        {"name", name_of(check)},           {"unit", unit_of(check)}, {"value", check.value},
        {"limit", check.demanded},          {"passed", check.passed}, {"violation", violation(check)},
        {"words", limit_words(check, rest)}};
    if (check.kind == CheckKind::quality && limits != nullptr)
      json["share"] = share_of_limit({check.measure, check.value, check.where, check.other}, *limits);
    list.push_back(std::move(json));
  }
  return list;
}

const QualityLimits* limits_of(const EditingSession& session) {
  const auto& quality = session.checker().requirements().quality;
  return quality ? &*quality : nullptr;
}

const std::vector<std::string>& names_of(const EditingSession& session) {
  return session.space().rest().shape.part_names;
}

/// The first group of a change in words.
std::string first_line(const Explanation& explanation) {
  return explanation.groups.empty() ? explanation_lines(explanation).front()
                                    : describe(explanation.groups.front(), explanation);
}

Json diagnosis_json(const std::optional<Diagnosis>& diagnosis, const Structure& rest) {
  if (!diagnosis) return nullptr;
  Json blockers = Json::array();
  for (const Blocker& blocker : diagnosis->blockers) blockers.push_back(describe(blocker, rest));
  return {{"reached", diagnosis->reached}, {"blockers", blockers}};
}

Json offers_json(const std::optional<Diagnosis>& diagnosis, const Structure& rest) {
  Json offers = Json::array();
  if (diagnosis)
    for (const Remedy& remedy : diagnosis->remedies)
      offers.push_back({{"words", describe(remedy, rest)}, {"stackability", remedy.stackability}});
  return offers;
}

Json to_json(const std::optional<StackLengthLimit>& limit) {
  return limit ? Json{{"copies", limit->copies}, {"length", limit->length}} : Json(nullptr);
}

class Frame {
 public:
  Frame(FrameKind kind, std::uint32_t number, Eigen::Index count, std::uint32_t stamp) {
    for (const std::uint32_t word :
         {static_cast<std::uint32_t>(kind), number, static_cast<std::uint32_t>(count), stamp})
      add(word);
  }

  void add(std::uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) bytes_ += static_cast<char>(word >> (8 * byte) & 0xff);
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(const Points& points) {
    bytes_.reserve(bytes_.size() + static_cast<std::size_t>(12 * points.rows()));
    for (Eigen::Index row = 0; row < points.rows(); ++row)
      for (int column = 0; column < 3; ++column) add(static_cast<float>(points(row, column)));
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace

std::string obstacle_words(const Obstacle& obstacle, const Structure& rest) {
  const auto* check = std::get_if<Check>(&obstacle);
  return check ? "limit: " + limit_words(*check, rest) : describe(obstacle, rest);
}

Json model_json(const EditingSession& session, const std::string& name) {
  const StructuredShape& rest = session.space().rest();
  Json parts = Json::array(), joints = Json::array(), pairs = Json::array(), symmetries = Json::array(),
       measures = Json::array();
  for (const Part& part : rest.structure.parts)
    parts.push_back(
        {{"name", part.name},
         {"text", handle_text({HandleKind::part, static_cast<int>(parts.size()), 0}, names_of(session))},
         {"kind", std::holds_alternative<Cuboid>(part.primitive) ? "cuboid" : "cylinder"}});
  for (std::size_t row = 0; row < rest.structure.relations.size(); ++row) {
    const Relation& relation = rest.structure.relations[row];
    if (relation.is_joint())
      joints.push_back(
          {{"relation", row}, {"parts", relation.parts}, {"points", points_json(relation.points)}});
    else
      pairs.push_back(
          {{"relation", row}, {"parts", relation.parts}, {"kind", name_of(relation.symmetry.kind)}});
  }
  for (const Symmetry& symmetry : rest.structure.symmetries)
    symmetries.push_back({{"kind", name_of(symmetry.kind)},
                          {"point", to_json(symmetry.point)},
                          {"axis", to_json(symmetry.axis)}});
  const QualityLimits defaults;
  for (std::size_t k = 0; k < quality_measure_count; ++k) {
    const auto measure = static_cast<QualityMeasure>(k);
    measures.push_back({{"name", name_of(measure)},
                        {"unit", unit_of(measure)},
                        {"limit", defaults[measure]},
                        {"lower", has_lower_limit(measure)}});
  }
  return {{"type", "model"},
          {"name", name},
          {"unit", to_json(rest.shape.unit)},
          {"diagonal", rest.structure.diagonal},
          {"parts", parts},
          {"joints", joints},
          {"pairs", pairs},
          {"symmetries", symmetries},
          {"measures", measures}};
}

Json design_json(const EditingSession& session) {
  const editing::MeasuredDesign& shown = session.shown();
  const Structure& rest = session.space().rest().structure;
  Json json = {{"type", "design"},
               {"dragging", session.dragging()},
               {"direction", to_json(session.direction().vector())},
               {"direction_words", direction_text(session.direction().vector())},
               {"measured", measured_json(shown.assessment.measured)},
               {"rest", measured_json(session.at_rest())},
               {"energy", to_json(shown.energy, alpha_shown)},
               {"change", shown.change.root_mean_square},
               {"reaches", session.checker().meets_target(shown.assessment.measured)},
               {"checks", checks_json(shown.assessment.checks, rest, limits_of(session))}};
  if (session.drag()) json["dragged"] = edit_text(*session.drag(), names_of(session));
  if (!session.dragging()) {
    json["primitives"] = Json::array();
    for (const Primitive& primitive : shown.design->primitives)
      json["primitives"].push_back(primitive_json(primitive));
  }
  return json;
}

Json review_json(const EditingSession& session) {
  Json json = {{"type", "review"}, {"ready", session.review().has_value()}};
  if (!session.review()) return json;
  const editing::Review& review = *session.review();
  json["words"] = explanation_lines(review.explanation);
  json["checks"] =
      checks_json(review.assessment.checks, session.space().rest().structure, limits_of(session));
  json["contacts"] = to_json(review.contacts, names_of(session));
  return json;
}

Json tree_json(const EditingSession& session) {
  const History& history = session.document().project.history;
  Json nodes = Json::array();
  for (const HistoryNode& node : history.nodes)
    nodes.push_back({{"parent", node.parent},
                     {"name", node.name},
                     {"stackability", node.stackability},
                     {"direction", to_json(node.direction)},
                     {"edits", edit_texts(node.edits, names_of(session))}});
  return {{"type", "tree"},
          {"current", history.current},
          {"nodes", nodes},
          {"can_undo", session.can_undo()},
          {"can_redo", session.can_redo()},
          {"saved", session.saved()}};
}

Json wishes_json(const EditingSession& session) {
  const Requirements& wishes = session.checker().requirements();
  Json limits = Json::object();
  if (wishes.quality)
    for (std::size_t k = 0; k < quality_measure_count; ++k) {
      const auto measure = static_cast<QualityMeasure>(k);
      limits[name_of(measure)] =
          wishes.quality->is_limited(measure) ? Json((*wishes.quality)[measure]) : Json(nullptr);
    }
  return {{"type", "wishes"},
          {"target", wishes.target},
          {"within", to_json(wishes.length_limit)},
          {"kept", wishes.kept_parts},
          {"limits", limits}};
}

Json suggestions_json(const EditingSession& session) {
  const Structure& rest = session.space().rest().structure;
  Json list = Json::array(), refused = Json::array();
  for (const editing::OfferedEdit& offered : session.suggestions()) {
    list.push_back({{"words", first_line(offered.explanation)},
                    {"edit", edit_text(offered.suggestion.edit.edit, names_of(session))},
                    {"gain", offered.gain},
                    {"stackability", offered.suggestion.measured.value},
                    {"f_max", offered.suggestion.measured.f_max},
                    {"change", offered.change.root_mean_square},
                    {"reaches", offered.suggestion.reaches_target}});
  }
  for (const ObstacleCount& count : session.refused()) refused.push_back(describe(count, rest));
  return {{"type", "suggestions"},
          {"complete", session.suggestions_complete()},
          {"list", list},
          {"refused", refused},
          {"diagnosis", diagnosis_json(session.diagnosis(), rest)},
          {"offers", offers_json(session.diagnosis(), rest)}};
}

Json range_json(const EditingSession& session) {
  if (!session.range()) return {{"type", "range"}, {"edit", nullptr}};
  const editing::HandleRange& range = *session.range();
  const Structure& rest = session.space().rest().structure;
  Json samples = Json::array();
  for (const editing::HandleRange::Sample& sample : range.samples)
    samples.push_back({sample.amount, sample.stackability});
  const auto words = [&](const std::optional<Obstacle>& obstacle) {
    return obstacle ? Json(obstacle_words(*obstacle, rest)) : Json(nullptr);
  };
  return {{"type", "range"},
          {"edit", edit_text(range.edit, names_of(session))},
          {"samples", samples},
          {"low", range.low},
          {"high", range.high},
          {"below", words(range.below)},
          {"above", words(range.above)}};
}

Json map_json(const EditingSession& session) {
  if (!session.map()) return {{"type", "map"}, {"ready", false}};
  const editing::DirectionMap& map = *session.map();
  Json samples = Json::array();
  for (const MapSample& sample : map.map.samples) {
    const Eigen::Vector3d& at = sample.direction;
    samples.push_back({at.x(), at.y(), at.z(), sample.stackability});
  }
  return {{"type", "map"},
          {"ready", true},
          {"samples", samples},
          {"best",
           {{"direction", to_json(map.best_direction)},
            {"words", direction_text(map.best_direction)},
            {"stackability", map.best}}}};
}

Json found_json(const EditingSession& session) {
  const editing::FoundDesigns& found = session.found();
  const Structure& rest = session.space().rest().structure;
  Json list = Json::array();
  for (const editing::FoundDesign& one : found.designs)
    list.push_back({{"number", one.number},
                    {"words", explanation_lines(one.explanation)},
                    {"stackability", one.candidate.measured.value},
                    {"f_max", one.candidate.measured.f_max},
                    {"direction", to_json(one.candidate.direction)},
                    {"change", one.change.root_mean_square}});
  return {{"type", "found"},
          {"target", found.target},
          {"within", to_json(found.within)},
          {"front", found.front},
          {"at_rest", found.at_rest},
          {"running", found.running},
          {"list", list},
          {"diagnosis", diagnosis_json(found.diagnosis, rest)},
          {"offers", offers_json(found.diagnosis, rest)}};
}

std::string mesh_frame(const Shape& shape) {
  Frame frame(FrameKind::mesh, static_cast<std::uint32_t>(shape.triangle_count()), shape.vertex_count(), 0);
  frame.add(shape.vertices);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) frame.add(static_cast<std::uint32_t>(shape.triangles(t, k)));
  for (const std::int32_t part : shape.triangle_part) frame.add(static_cast<std::uint32_t>(part));
  return frame.take();
}

std::string vertex_frame(FrameKind kind, std::uint32_t number, std::uint32_t stamp, const Points& vertices) {
  Frame frame(kind, number, vertices.rows(), stamp);
  frame.add(vertices);
  return frame.take();
}

std::string contact_frame(const std::vector<ContactRegion>& regions) {
  Eigen::Index count = 0;
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons)
      count += std::max<Eigen::Index>(polygon.upper_points.rows() - 2, 0);
  Frame frame(FrameKind::contacts, 0, count, 0);
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons)
      for (Eigen::Index k = 2; k < polygon.upper_points.rows(); ++k) {
        Points corners(3, 3);
        corners << polygon.upper_points.row(0), polygon.upper_points.row(k - 1), polygon.upper_points.row(k);
        frame.add(corners);
      }
  return frame.take();
}

std::string envelope_frame(const HeightField& envelopes) {
  const Window& window = envelopes.window;
  const Eigen::Vector2d first = window.sample(0, 0);
  Points head(4, 3);
  head.row(0) = envelopes.frame.to_world({first.x(), first.y(), 0}).transpose();
  head.row(1) = window.pixel_size * envelopes.frame.u.transpose();
  head.row(2) = window.pixel_size * envelopes.frame.v.transpose();
  head.row(3) = envelopes.frame.w.transpose();
  Frame frame(FrameKind::envelopes, static_cast<std::uint32_t>(window.columns), envelopes.upper.size(), 0);
  frame.add(head);
  for (const Eigen::MatrixXd* heights : {&envelopes.upper, &envelopes.lower})
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i)
        frame.add(envelopes.covered(i, j) ? static_cast<float>((*heights)(i, j))
                                          : std::numeric_limits<float>::quiet_NaN());
  return frame.take();
}

}  // namespace stackabilization::apps
