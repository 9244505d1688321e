#pragma once

#include <string>

#include "stackabilization/editing/session.h"

namespace stackabilization::apps {

/// One HTML page about the design that a session shows, with everything in it: what was asked for, what
/// changed from the shape at rest and by which edits, how high `copies` copies are before and after, what
/// comes near a limit, and a 3-D view of both. Also well-formed as XML. Explains the change where the review
/// of the session has not done so yet. `name`: of the model.
std::string session_page(const editing::EditingSession& session, const std::string& name, int copies);

}  // namespace stackabilization::apps
