#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "stackabilization/editing/session.h"
#include "support/structures.h"

/// Sessions for the tests, whose jobs run when they are told to.
namespace stackabilization::editing::sessions {

/// A session with the events that it emitted.
struct Observed {
  explicit Observed(Document document, SessionOptions options = {})
      : session(std::move(document), std::move(options),
                [this](const Event& event) { events.push_back(event); }) {}

  /// Runs all jobs of a lane, and hands in what they find.
  void work(Lane lane = Lane::advice) {
    while (const auto job = session.next_job(lane))
      (*job)([](const EditingSession::Result& result) { result(); });
  }

  template <class Kind>
  std::vector<Kind> all() const {
    std::vector<Kind> found;
    for (const Event& event : events)
      if (const auto* one = std::get_if<Kind>(&event)) found.push_back(*one);
    return found;
  }

  std::vector<Event> events;  // before the session, which emits into it
  EditingSession session;
};

inline Document table_document() {
  return new_document(structures::table(1));
}

}  // namespace stackabilization::editing::sessions
