#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/editor/server.h"
#include "apps/editor/session_locks.h"
#include "apps/editor/study_desk.h"
#include "stackabilization/editing/session.h"

namespace stackabilization::apps {

/// A model that takes the place of the first one.
struct DroppedModel {
  editing::Document document;
  std::string name, stem;          ///< see RoomOptions
  std::filesystem::path autosave;  ///< of its session
  SessionLock lock;                ///< of that file
};

struct RoomOptions {
  std::string name;      ///< of the model, for people
  std::string stem;      ///< of files that are exported, without folder and ending
  bool resumed = false;  ///< whether the session goes on with what was saved
  editing::SessionOptions session;
  SessionLock lock;  ///< of the file in which the session is saved
  /// Makes a document of a file that a person drops onto the page: its name, and its bytes. The shape is
  /// written beside the model under that name. Throws Error.
  std::function<DroppedModel(const std::string& name, const std::string& bytes)> open;
  std::optional<StudyOptions> study;  ///< tasks for a participant, instead of a free session
};

/// An editing session, the pages that look at it, and one page that edits: the first one, and when it leaves
/// the next one, or whichever asks for it. Everything happens on the thread of the session. Whatever fails is
/// told to the pages; nothing but a signal or the last page ends it.
class EditingRoom {
 public:
  /// Without a document pages are asked for a mesh file first. Throws as EditingSession.
  EditingRoom(std::optional<editing::Document> document, RoomOptions options, WebOptions web);
  ~EditingRoom();
  EditingRoom(const EditingRoom&) = delete;
  EditingRoom& operator=(const EditingRoom&) = delete;

  std::string address() const;
  /// Serves until the last page has left, or a signal. Returns what was edited; nothing where nothing was
  /// opened.
  std::optional<editing::Document> run();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stackabilization::apps
