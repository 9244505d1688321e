#pragma once

#include "apps/common/json.h"
#include "stackabilization/editing/session.h"

namespace stackabilization::apps {

/// Reads a command of a page, one JSON object:
///
///     {"do": "apply", "number": 0}                  {"do": "roll-back", "node": 2}
///     {"do": "drag", "edit": "leg move 0 0 1"}      {"do": "end-drag", "keep": true}
///     {"do": "range", "edit": "leg move 0 0 1"}     {"do": "undo"}, {"do": "redo"}
///     {"do": "target", "value": 0.6}                {"do": "direction", "direction": [0, 0, 1]}
///     {"do": "limit", "measure": "size", "value": 0.7}    (value null: none)
///     {"do": "keep", "parts": [0, 3]}
///     {"do": "segment", "strokes": [{"part": "handle", "triangles": [7, 8]}]}
///     {"do": "kind", "part": 0, "kind": "cuboid"}       {"do": "remove-relations", "relations": [4]}
///     {"do": "find"}, {"do": "stop"}, {"do": "take", "number": 0}, {"do": "accept", "number": 0}
///     {"do": "accept-advice", "number": 0}              {"do": "take-edit", "node": 2, "edit": 0}
///     {"do": "remove-parts", "parts": [3]}              {"do": "join", "parts": [0, 3]}
///     {"do": "make-symmetric", "parts": [0, 3]}         {"do": "map"}
///     {"do": "within", "copies": 5, "length": 2.2}      {"do": "envelopes"}
///
/// Edits are those of edit_grammar.h. Throws UsageError, in words for people, for anything else.
editing::Command page_command(const Json& json, const StructuredShape& rest);

/// Returns what a page asks for, "apply" above; empty for a text that is no command.
std::string command_word(const Json& json);
/// Returns a number of a command that counts from 0. Throws UsageError as `page_command`.
int command_number(const Json& json, const char* key);

}  // namespace stackabilization::apps
