#pragma once

#include <functional>
#include <string>
#include <variant>

#include "stackabilization/improvement/checks.h"

/// Events of an editing session: what a window has to draw again.
namespace stackabilization::editing {

/// What changed in a session.
enum class Change {
  structure,    ///< the shape at rest: its parts, primitives and relations; everything else follows
  design,       ///< EditingSession::shown: the mesh, and S and E with it
  review,       ///< EditingSession::review
  tree,         ///< the history, and what can be undone
  wishes,       ///< the requirements
  suggestions,  ///< EditingSession::suggestions
  range,        ///< EditingSession::range
  found,        ///< EditingSession::found
  map,          ///< EditingSession::map
  envelopes,    ///< EditingSession::envelopes
};

/// Something in the session changed.
struct Changed {
  Change what = Change::design;  ///< what changed
};

/// An edit was not made, or only in part.
struct Refused {
  Obstacle obstacle;  ///< what stands against it
};

/// Work in the background that reports its progress.
enum class Work {
  suggestions,  ///< suggestions for the current design
  designs,      ///< the automatic search
};

/// Progress of work in the background.
struct Progress {
  Work work = Work::suggestions;  ///< which work
  double fraction = 0;            ///< share that is done, in [0, 1]; 1: it ended
};

/// Something failed that the user has to know of, such as the file of the session that cannot be written.
struct Failed {
  std::string sentence;  ///< what failed, in the user's words
};

/// An event.
using Event = std::variant<Changed, Refused, Progress, Failed>;

/// Receives events. Called from the thread that uses the session. It may ask the session, but must not
/// execute commands.
using Listener = std::function<void(const Event&)>;

}  // namespace stackabilization::editing
