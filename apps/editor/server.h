#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// HTTP and WebSocket on 127.0.0.1, for one page that knows a random word.
namespace stackabilization::apps {

/// A request for a path below the secret folder.
struct WebRequest {
  std::string method;  ///< "GET" or "POST"
  std::string path;    ///< without the secret folder and the query: "index.html"
  std::string query;   ///< after "?", as it came
  std::string body;    ///< of POST
};

struct WebReply {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::string download;  ///< name under which a browser keeps it; empty: it is shown
};

/// Identifies a page that is connected.
using PageId = std::uint64_t;

struct WebHandlers {
  /// Answers a request. The answer may come later and from any thread.
  std::function<void(WebRequest, std::function<void(WebReply)>)> request;
  std::function<void(PageId)> opened;
  std::function<void(PageId)> closed;
  std::function<void(PageId, std::string)> message;  ///< text of a page
};

struct WebOptions {
  unsigned short port = 0;                           ///< 0: any that is free
  bool keep_open = false;                            ///< go on when the last page has left
  double grace_seconds = 5;                          ///< time in which a page that left may come back
  std::string upload;                                ///< path to which a page may POST a file
  std::size_t max_upload = std::size_t{256} << 20;   ///< of that file, bytes
  std::size_t max_body = std::size_t{64} << 10;      ///< of any other request, bytes
  std::size_t max_message = std::size_t{4} << 20;    ///< of a page, bytes
  std::size_t max_waiting = std::size_t{512} << 20;  ///< that a slow page has not taken yet, bytes
};

/// Every answer is for who knows the secret folder, comes from a page of this server (Host and Origin) and is
/// not meant for another site; the body of a request is read only after that is known. Handlers are called
/// from the thread of `run`.
class WebServer {
 public:
  /// Listens. Throws OutputError when the port cannot be had.
  WebServer(WebOptions options, WebHandlers handlers);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Address of the page, with the secret.
  std::string address() const;
  /// Serves until a signal, or until the last page has left.
  void run();

  /// Sends to a page; nothing happens if it has left. From any thread. `replaces`: a message of the same
  /// number that still waits for this page is left out; 0: none is.
  void send_text(PageId page, std::string text, std::uint32_t replaces = 0);
  void send_bytes(PageId page, std::shared_ptr<const std::string> bytes, std::uint32_t replaces = 0);
  /// Closes a page that breaks the rules.
  void close(PageId page, std::string reason);

 private:
  class Implementation;
  std::shared_ptr<Implementation> implementation_;
};

}  // namespace stackabilization::apps
