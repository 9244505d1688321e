#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/improvement/history.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::editing {

/// Everything that a session keeps between two starts of the program.
struct Document {
  Project project;            ///< shape at rest, and the tree of its designs; at least the root
  Requirements requirements;  ///< what is wanted of designs
  std::vector<int> visited;   ///< nodes in the order in which they became current, for Undo; not empty
  std::size_t place = 0;      ///< row of `visited` that is current; the rows after it are for Redo
  std::string source;         ///< says of which file the shape was made, such as a hash of it; may be empty
};

/// Returns the document of a shape that nobody has edited: limits of quality with their defaults, and the
/// target that is offered first, S + 0.2 rounded to two digits, at most 0.9. Throws as `deformation_model`
/// and StackabilitySolver.
Document new_document(StructuredShape rest, const StackabilityOptions& measure = {});

/// Returns the document of a project file: new where it has no history.
Document document_of(Project project, const StackabilityOptions& measure = {});

/// Returns the document as JSON text:
///
///     {"format": "stackabilize session", "version": 1, "target": 0.6, "keep_height": true,
///      "kept_parts": ["seat"], "limits": {"size": 0.8, "bending": null}, "visited": [0, 1], "place": 1,
///      "source": "", "within": {"copies": 5, "length": 2.2}, "project": {...}}
///
/// `within` is null, or missing, where no length limits the stack. `limits` has the measures whose limit is
/// not the default; null is no limit. `project` is a project file (improvement/history.h). Throws as
/// `project_text`.
std::string document_text(const Document& document);

/// Reads a document. `measure`: meaning of S, which the text does not hold. Throws InputError naming `name`
/// and the place in the text where it is not as described.
Document document_of_text(std::string_view text, const std::string& name,
                          const StackabilityOptions& measure = {});

}  // namespace stackabilization::editing
