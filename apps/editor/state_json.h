#pragma once

#include <memory>
#include <string>

#include "apps/common/json.h"
#include "stackabilization/editing/session.h"

/// What a page is told of a session: texts in JSON, and frames of little-endian numbers for what is large.
namespace stackabilization::apps {

/// {type: "model", name, unit, diagonal, parts: [{name, text, kind}], joints: [{relation, parts, points}],
/// pairs: [{relation, parts, kind}], symmetries: [{kind, point, axis}], measures: [{name, unit, limit,
/// lower}]}
Json model_json(const editing::EditingSession& session, const std::string& name);

/// {type: "design", dragging, direction, direction_words, measured, rest, energy, change, reaches, checks,
/// and dragged (an edit) or primitives}: what follows every step of a drag.
Json design_json(const editing::EditingSession& session);
/// {type: "review", ready, words, checks, contacts}
Json review_json(const editing::EditingSession& session);
/// {type: "tree", current, nodes: [{parent, name, stackability, direction, edits}], can_undo, can_redo,
/// saved}
Json tree_json(const editing::EditingSession& session);
/// {type: "wishes", target, within: {copies, length}, kept, limits}; within is null where a target is wanted
Json wishes_json(const editing::EditingSession& session);
/// {type: "suggestions", complete, list: [{words, edit, gain, stackability, f_max, change, reaches}],
/// refused, diagnosis, offers}
Json suggestions_json(const editing::EditingSession& session);
/// {type: "range", edit, samples, low, high, below, above}; edit is null where there is none
Json range_json(const editing::EditingSession& session);
/// {type: "map", ready, samples: [[x, y, z, S]], best: {direction, words, stackability}}
Json map_json(const editing::EditingSession& session);
/// {type: "found", target, within, front, at_rest, running, list: [{number, words, stackability, f_max,
/// direction, change}], diagnosis, offers}
Json found_json(const editing::EditingSession& session);

/// What stands against an edit, as the page says it.
std::string obstacle_words(const Obstacle& obstacle, const Structure& rest);

/// Kinds of frames. A frame is uint32 {kind, number, points or triangles, stamp}, then its numbers.
enum class FrameKind : std::uint32_t {
  mesh = 1,        ///< float32 vertices at rest, then uint32 triangles, then uint32 part per triangle; the
                   ///< number is the number of triangles
  shown = 2,       ///< float32 vertices of the design that is shown
  suggestion = 3,  ///< float32 vertices of suggestion `number`
  node = 4,        ///< float32 vertices of node `number`
  found = 5,       ///< float32 vertices of the found design with that `number`
  contacts = 6,    ///< float32 corners of the triangles of the contact regions on the copy below
  envelopes = 7,  ///< samples of envelopes, `number` columns of `points`: float32 x, y, z of the first one at
                  ///< height 0, of the steps to the next column and row and of the unit of height; then upper
                  ///< heights row by row, not a number where there is no surface; then lower heights
};

/// Returns the frame of the mesh.
std::string mesh_frame(const Shape& shape);
/// Returns a frame of vertices.
std::string vertex_frame(FrameKind kind, std::uint32_t number, std::uint32_t stamp, const Points& vertices);
/// Returns the frame of contact regions.
std::string contact_frame(const std::vector<ContactRegion>& regions);
/// Returns the frame of envelopes.
std::string envelope_frame(const HeightField& envelopes);

}  // namespace stackabilization::apps
