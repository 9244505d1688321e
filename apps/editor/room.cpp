#include "apps/editor/room.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/common/page_files.h"
#include "apps/editor/page_command.h"
#include "apps/editor/session_page.h"
#include "apps/editor/state_json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/failure_sentence.h"
#include "stackabilization/editing/command_loop.h"
#include "stackabilization/io/write.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::apps {

namespace {

using editing::Change, editing::Changed, editing::CommandLoop, editing::Document, editing::EditingSession,
    editing::EndDrag, editing::Event, editing::OfferedEdit, editing::Progress, editing::Refused,
    editing::Work;

/// Messages that replace an earlier one of the same number that still waits; see WebServer::send_text.
enum Replaces : std::uint32_t { keeps_all = 0, shown_frame, design_text, review_text, progress_text };

/// Commands of one page that may wait; a page that sends more is flooding.
constexpr int max_waiting_commands = 1000;

constexpr const char* plain_type = "text/plain; charset=utf-8";
constexpr const char* binary_type = "application/octet-stream";
constexpr const char* page_type = "text/html; charset=utf-8";

struct Export {
  const char* ending;
  const char* type;
  std::optional<Format> format;  ///< none: the project or the page
};

/// Commands of one page that the session has not obeyed yet. Those of a page that floods are dropped, so that
/// the others need not wait for them.
struct Backlog {
  std::atomic<int> waiting = 0;
  std::atomic<bool> floods = false;
};

/// Returns the number in a query "copies=...", for the heights of stacks; 10 without a query.
int copies_of(const std::string& query) {
  constexpr std::string_view key = "copies=";
  constexpr int default_copies = 10, min_copies = 2, max_copies = 1000;
  if (query.empty()) return default_copies;
  int copies = 0;
  const char* const end = query.data() + query.size();
  if (!query.starts_with(key) || std::from_chars(query.data() + key.size(), end, copies).ptr != end ||
      copies < min_copies || copies > max_copies)
    throw UsageError("'copies' expects a number from 2 to 1000");
  return copies;
}

/// The path to which a page sends a file that a person has dropped.
constexpr const char* upload_path = "open";

WebOptions with_upload(WebOptions options) {
  options.upload = upload_path;
  return options;
}

/// The name in a query "name=...", with what was escaped.
std::string decoded(const std::string& query) {
  const std::string key = "name=";
  if (query.compare(0, key.size(), key) != 0) throw UsageError("'open' expects the name of a file");
  std::string text;
  for (std::size_t k = key.size(); k < query.size(); ++k) {
    unsigned value = 0;
    const char* const digits = query.data() + k + 1;
    if (query[k] == '%' && k + 2 < query.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      text += static_cast<char>(value);
      k += 2;
    } else {
      text += query[k];
    }
  }
  return text;
}

/// What a session needs while nothing is opened. No page sees it.
Document placeholder() {
  Shape tetrahedron;
  tetrahedron.vertices.resize(4, 3);
  tetrahedron.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.triangles.resize(4, 3);
  tetrahedron.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  tetrahedron.triangle_part.assign(4, 0);
  tetrahedron.part_names = {"part"};
  return editing::new_document(analyse_structure(tetrahedron));
}

const Export* export_of(const std::string& path) {
  static const std::vector<Export> exports = {{"obj", "text/plain; charset=utf-8", Format::obj},
                                              {"3mf", "model/3mf", Format::three_mf},
                                              {"glb", "model/gltf-binary", Format::gltf},
                                              {"stl", binary_type, Format::stl},
                                              {"stackabilize.json", "application/json", std::nullopt},
                                              {"html", page_type, std::nullopt}};
  for (const Export& one : exports)
    if (path == std::string("export/") + one.ending) return &one;
  return nullptr;
}

}  // namespace

class EditingRoom::Implementation {
 public:
  Implementation(std::optional<Document> document, RoomOptions options, WebOptions web)
      : options_(std::move(options)),
        empty_(!document),
        server_(with_upload(std::move(web)),
                {[this](WebRequest request, auto reply) { answer(std::move(request), reply); },
                 [this](PageId page) { arrived(page); }, [this](PageId page) { left(page); },
                 [this](PageId page, const std::string& text) { received(page, text); }}) {
    auto session =
        std::make_unique<EditingSession>(document ? std::move(*document) : placeholder(), options_.session,
                                         [this](const Event& event) { tell(event); });
    session_ = session.get();
    if (options_.study) study_.emplace(std::move(*options_.study));
    loop_.emplace(std::move(session));
  }

  std::string address() const { return server_.address(); }
  std::optional<Document> run() {
    server_.run();
    std::promise<std::optional<Document>> last;
    loop_->post([this, &last](EditingSession& session) {
      last.set_value(empty_ ? std::nullopt : std::optional(session.document()));
    });
    return last.get_future().get();
  }

 private:
  template <class Function>
  void post(Function function) {
    loop_->post([this, function = std::move(function)](EditingSession&) { attempt(pages_, function); });
  }

  /// The one door for failures: does something, and tells pages what went wrong. The program goes on.
  template <class Function>
  void attempt(const std::vector<PageId>& pages, const Function& function) {
    try {
      function();
    } catch (const std::exception& failure) {
      for (const PageId page : pages) send(page, {{"type", "error"}, {"words", failure_sentence(failure)}});
    }
  }

  // From here on: the thread of the server.

  void arrived(PageId page) {
    backlogs_[page] = std::make_shared<Backlog>();
    post([this, page] { opened(page); });
  }

  void left(PageId page) {
    backlogs_.erase(page);
    post([this, page] { closed(page); });
  }

  void received(PageId page, const std::string& text) {
    const auto found = backlogs_.find(page);
    if (found == backlogs_.end() || found->second->floods) return;
    const std::shared_ptr<Backlog> backlog = found->second;
    if (backlog->waiting >= max_waiting_commands) {
      backlog->floods = true;
      return server_.close(page, "too many commands");
    }
    ++backlog->waiting;
    const auto counted = std::shared_ptr<void>(nullptr, [backlog](void*) { --backlog->waiting; });
    attempt({page}, [&] {
      const auto json = std::make_shared<const Json>(Json::parse(text, nullptr, false));
      const auto task = [this, page, json, backlog, counted](EditingSession&) {
        if (!backlog->floods) attempt({page}, [&] { obey(page, *json); });
      };
      if (command_word(*json) == "drag")
        loop_->post_drag(task, page);
      else
        loop_->post(task);
    });
  }

  void answer(WebRequest request, const std::function<void(WebReply)>& reply) {
    if (request.path.empty()) request.path = "index.html";
    if (const auto file = page_file(request.path); file && request.method == "GET")
      return reply({200, file->type, std::string(file->bytes), ""});
    if (request.path == upload_path && request.method == "POST")
      return post([this, request = std::move(request), reply] { reply(dropped(request)); });
    const Export* const wanted = export_of(request.path);
    if (!wanted || request.method != "GET") return reply({404, plain_type, "not found", ""});
    post([this, wanted, query = std::move(request.query), reply] { reply(exported(*wanted, query)); });
  }

  // From here on: the thread of the session.

  std::string export_bytes(const Export& wanted, const std::string& query) const {
    if (wanted.format) return shape_bytes(session_->shown().design->shape, *wanted.format);
    if (wanted.type == page_type) return session_page(*session_, options_.name, copies_of(query));
    return project_text(session_->document().project);
  }

  WebReply exported(const Export& wanted, const std::string& query) const {
    if (empty_) return {404, plain_type, "nothing is opened", ""};
    try {
      return {200, wanted.type, export_bytes(wanted, query), options_.stem + "." + wanted.ending};
    } catch (const UsageError& error) {
      return {400, plain_type, error.what(), ""};
    } catch (const std::exception& failure) {
      return {500, plain_type, failure_sentence(failure), ""};
    }
  }

  /// Goes on with the file that a person has dropped.
  WebReply dropped(const WebRequest& request) {
    try {
      if (study_) throw UsageError("a study has its own models");
      if (!options_.open) throw UsageError("files cannot be opened here");
      open(options_.open(decoded(request.query), request.body));
      return {200, plain_type, "opened", ""};
    } catch (const std::exception& failure) {
      return {422, plain_type, failure_sentence(failure), ""};
    }
  }

  void open(DroppedModel model) {
    RoomOptions options = options_;
    options.session.autosave = model.autosave;
    options.name = model.name;
    options.stem = model.stem;
    options.lock = std::move(model.lock);
    options.resumed = false;
    std::swap(options_, options);
    const bool empty = std::exchange(empty_, false);
    try {
      session_->open(std::move(model.document), options_.session);
    } catch (...) {
      std::swap(options_, options);
      empty_ = empty;
      throw;
    }
  }

  void opened(PageId page) {
    pages_.push_back(page);
    if (!writer_) writer_ = page;
    tell_writers();
    if (empty_) return send(page, {{"type", "empty"}});
    if (study_) send(page, study_->state());
    for (const Change change :
         {Change::structure, Change::wishes, Change::design, Change::tree, Change::review,
          Change::suggestions, Change::range, Change::found, Change::map, Change::envelopes})
      show(change, {page});
  }

  void closed(PageId page) {
    std::erase(pages_, page);
    if (writer_ != page) return;
    writer_.reset();
    if (session_->dragging()) session_->execute(EndDrag{false});
    if (!pages_.empty()) writer_ = pages_.front();
    tell_writers();
  }

  void obey(PageId page, const Json& json) {
    if (std::find(pages_.begin(), pages_.end(), page) == pages_.end()) return;
    const std::string word = command_word(json);
    if (word == "write") {
      if (session_->dragging()) session_->execute(EndDrag{false});
      writer_ = page;
      tell_writers();
    } else if (word == "picture" && !empty_) {
      send_picture(page, command_number(json, "node"));
    } else if (writer_ != page) {
      throw UsageError("another page is editing; this one looks on");
    } else if (empty_) {
      throw UsageError("open a mesh file first");
    } else if (word == "study") {
      step_study(page, json);
    } else {
      const editing::Command command = page_command(json, session_->space().rest());
      if (study_) study_->check(command);
      session_->execute(command);
    }
  }

  /// Tells a page how a node looks, and how far apart its copies are.
  void send_picture(PageId page, int node) {
    const std::shared_ptr<const Design> design = session_->design_of(node);
    send(page, {{"type", "node"}, {"node", node}, {"f_max", session_->f_max_of(node)}});
    send_frame(page,
               vertex_frame(FrameKind::node, static_cast<std::uint32_t>(node), 0, design->shape.vertices));
  }

  void step_study(PageId page, const Json& json) {
    if (!study_) throw UsageError("this is no study");
    const Json before = study_->state();
    attempt({page}, [&] { study_->step(json, *session_); });
    if (const Json now = study_->state(); now != before)
      for (const PageId one : pages_) send(one, now);
  }

  void tell(const Event& event) {
    attempt(pages_, [&] { report(event); });
  }

  void report(const Event& event) {
    if (const auto* changed = std::get_if<Changed>(&event)) {
      show(changed->what, pages_);
      if (changed->what == Change::tree && study_) study_->note(*session_);
      return;
    }
    if (empty_) return;
    Json json;
    std::uint32_t replaces = keeps_all;
    if (const auto* refused = std::get_if<Refused>(&event)) {
      json = {{"type", "refusal"},
              {"words", obstacle_words(refused->obstacle, session_->space().rest().structure)}};
    } else if (const auto* progress = std::get_if<Progress>(&event)) {
      json = {{"type", "progress"},
              {"work", progress->work == Work::designs ? "designs" : "suggestions"},
              {"fraction", progress->fraction}};
      if (progress->fraction < 1) replaces = progress_text;
    } else {
      json = {{"type", "error"}, {"words", std::get<editing::Failed>(event).sentence}};
    }
    for (const PageId page : pages_) send(page, json, replaces);
  }

  /// Tells pages what changed.
  void show(Change change, const std::vector<PageId>& pages) {
    if (pages.empty() || empty_) return;
    const auto all = [&](const Json& json, std::uint32_t replaces = keeps_all) {
      for (const PageId page : pages) send(page, json, replaces);
    };
    switch (change) {
      case Change::structure:
        all(model());
        return frames(pages, mesh_frame(session_->space().rest().shape));
      case Change::design:
        ++stamp_;
        frames(pages, vertex_frame(FrameKind::shown, 0, stamp_, session_->shown().design->shape.vertices),
               shown_frame);
        return all(design_json(*session_), session_->dragging() ? design_text : keeps_all);
      case Change::review:
        if (session_->review()) frames(pages, contact_frame(session_->review()->contacts));
        return all(review_json(*session_), review_text);
      case Change::tree:
        return all(tree_json(*session_));
      case Change::wishes:
        return all(wishes_json(*session_));
      case Change::suggestions: {
        ++stamp_;
        std::uint32_t number = 0;
        for (const OfferedEdit& offered : session_->suggestions())
          frames(pages,
                 vertex_frame(FrameKind::suggestion, number++, stamp_, offered.design->shape.vertices));
        Json json = suggestions_json(*session_);
        json["stamp"] = stamp_;
        return all(json);
      }
      case Change::range:
        return all(range_json(*session_));
      case Change::envelopes:
        if (session_->envelopes()) frames(pages, envelope_frame(*session_->envelopes()));
        return;
      case Change::map:
        return all(map_json(*session_));
      case Change::found: {
        for (const editing::FoundDesign& one : session_->found().designs)
          frames(pages, vertex_frame(FrameKind::found, static_cast<std::uint32_t>(one.number), stamp_,
                                     one.candidate.design.shape.vertices));
        return all(found_json(*session_));
      }
    }
  }

  Json model() const {
    Json json = model_json(*session_, options_.name);
    json["stem"] = options_.stem;
    json["resumed"] = options_.resumed;
    return json;
  }

  void tell_writers() {
    for (const PageId page : pages_) send(page, {{"type", "role"}, {"writes", writer_ == page}});
  }

  void send(PageId page, const Json& json, std::uint32_t replaces = keeps_all) {
    server_.send_text(page, json.dump(-1, ' ', false, Json::error_handler_t::replace), replaces);
  }
  void send_frame(PageId page, std::string frame) { frames({page}, std::move(frame)); }
  void frames(const std::vector<PageId>& pages, std::string frame, std::uint32_t replaces = keeps_all) {
    const auto bytes = std::make_shared<const std::string>(std::move(frame));
    for (const PageId page : pages) server_.send_bytes(page, bytes, replaces);
  }

  RoomOptions options_;
  bool empty_;  ///< whether nothing is opened yet
  std::optional<StudyDesk> study_;
  std::vector<PageId> pages_;
  std::optional<PageId> writer_;
  std::uint32_t stamp_ = 0;
  std::map<PageId, std::shared_ptr<Backlog>> backlogs_;  ///< of the thread of the server
  WebServer server_;
  EditingSession* session_ = nullptr;  ///< of the loop
  std::optional<CommandLoop> loop_;    ///< last: its threads use everything above
};

EditingRoom::EditingRoom(std::optional<Document> document, RoomOptions options, WebOptions web)
    : implementation_(std::make_unique<Implementation>(std::move(document), std::move(options), web)) {}

EditingRoom::~EditingRoom() = default;

std::string EditingRoom::address() const {
  return implementation_->address();
}

std::optional<Document> EditingRoom::run() {
  return implementation_->run();
}

}  // namespace stackabilization::apps
