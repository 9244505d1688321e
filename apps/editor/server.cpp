#include "apps/editor/server.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds request_timeout{60};

/// 128 bits that nobody can guess, as a word.
std::string secret_word() {
  std::random_device device;
  std::string word;
  constexpr const char* digits = "0123456789abcdef";
  for (int k = 0; k < 32; ++k) word += digits[device() % 16];
  return word;
}

/// Is this the Host of a page on this machine? Another port is fine: a tunnel may have one.
bool is_local(std::string host) {
  const std::size_t colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.erase(colon);
  return host == "127.0.0.1" || host == "localhost" || host == "[::1]";
}

std::string text_of(beast::string_view text) {
  return {text.data(), text.size()};
}

struct Outgoing {
  std::shared_ptr<const std::string> bytes;
  bool binary = false;
  std::uint32_t replaces = 0;
};

}  // namespace

class WebServer::Implementation : public std::enable_shared_from_this<WebServer::Implementation> {
 public:
  Implementation(WebOptions options, WebHandlers handlers)
      : options_(options),
        handlers_(std::move(handlers)),
        acceptor_(context_),
        signals_(context_, SIGINT, SIGTERM),
        grace_(context_) {
    try {
      const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), options_.port);
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw OutputError("port " + std::to_string(options_.port) +
                        " of this machine cannot be had: " + error.code().message());
    }
  }

  std::string address() const {
    return "http://127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port()) + "/" + secret_ + "/";
  }

  void run() {
    accept();
    signals_.async_wait([this](error_code error, int) {
      if (!error) context_.stop();
    });
    context_.run();
    pages_.clear();
  }

  void send(PageId page, Outgoing message);
  void close(PageId page, std::string reason);

 private:
  class Page;
  class Connection;

  void accept();

  void open(const std::shared_ptr<Page>& page, PageId id) {
    grace_.cancel();
    pages_[id] = page;
    handlers_.opened(id);
  }

  void left(PageId id) {
    if (pages_.erase(id) == 0) return;
    handlers_.closed(id);
    if (!pages_.empty() || options_.keep_open) return;
    grace_.expires_after(std::chrono::milliseconds(static_cast<int>(1000 * options_.grace_seconds)));
    grace_.async_wait([this](error_code error) {
      if (!error && pages_.empty()) context_.stop();
    });
  }

  WebOptions options_;
  WebHandlers handlers_;
  std::string secret_ = secret_word();
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::signal_set signals_;
  asio::steady_timer grace_;
  std::map<PageId, std::shared_ptr<Page>> pages_;
  PageId next_page_ = 1;
};

/// A connected page.
class WebServer::Implementation::Page : public std::enable_shared_from_this<Page> {
 public:
  Page(Implementation& server, PageId id, tcp::socket socket)
      : server_(server), id_(id), stream_(std::move(socket)) {}

  void accept(const http::request<http::string_body>& upgrade) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.read_message_max(server_.options_.max_message);
    stream_.auto_fragment(false);
    stream_.async_accept(upgrade, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->server_.open(self, self->id_);
      self->read();
    });
  }

  void send(Outgoing message) {
    if (message.replaces != 0)
      for (std::size_t k = writing_ ? 1 : 0; k < waiting_.size(); ++k)
        if (waiting_[k].replaces == message.replaces) {
          waiting_bytes_ -= waiting_[k].bytes->size();
          waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(k));
          break;
        }
    waiting_bytes_ += message.bytes->size();
    waiting_.push_back(std::move(message));
    if (waiting_bytes_ > server_.options_.max_waiting) return close("too slow");
    write();
  }

  void close(const std::string& reason) {
    if (closing_) return;
    closing_ = true;
    stream_.async_close(websocket::close_reason(websocket::close_code::policy_error, reason),
                        [self = shared_from_this()](error_code) { self->server_.left(self->id_); });
  }

 private:
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->server_.left(self->id_);
      if (!self->stream_.got_text()) return self->close("expected text");
      std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->server_.handlers_.message(self->id_, std::move(text));
      self->read();
    });
  }

  void write() {
    if (writing_ || closing_ || waiting_.empty()) return;
    writing_ = true;
    const Outgoing& next = waiting_.front();
    stream_.binary(next.binary);
    stream_.async_write(asio::buffer(*next.bytes),
                        [self = shared_from_this()](error_code error, std::size_t) {
                          self->writing_ = false;
                          if (error) return self->server_.left(self->id_);
                          self->waiting_bytes_ -= self->waiting_.front().bytes->size();
                          self->waiting_.pop_front();
                          self->write();
                        });
  }

  Implementation& server_;
  PageId id_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool writing_ = false, closing_ = false;
};

/// A connection that has asked for a file, or for a WebSocket.
class WebServer::Implementation::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Implementation& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(server_.options_.max_upload);
    stream_.expires_after(request_timeout);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error == http::error::body_limit) return self->answer(too_large(), false);
                              if (!error) self->admit();
                            });
  }

 private:
  static WebReply too_large() { return {413, "text/plain", "too large", ""}; }

  /// Decides by the head of a request whether it is answered at all, and how much more of it is read.
  void admit() {
    const http::request<http::string_body>& request = parser_->get();
    // What is left of a refused request must not be taken for the next one.
    const bool keeps = request.keep_alive() && parser_->is_done();
    const std::string host = text_of(request[http::field::host]);
    if (!is_local(host))
      return answer({403, "text/plain", "this server is for this machine only", ""}, false);
    const std::string target = text_of(request.target()), folder = "/" + server_.secret_ + "/";
    if (target.compare(0, folder.size(), folder) != 0)
      return answer({404, "text/plain", "not found", ""}, keeps);
    const bool same_origin = text_of(request[http::field::origin]) == "http://" + host;
    const bool upgrade = websocket::is_upgrade(request);
    if ((upgrade || request.method() != http::verb::get) && !same_origin)
      return answer({403, "text/plain", "only the page of this server may do this", ""}, false);
    if (upgrade) {
      stream_.expires_never();
      std::make_shared<Page>(server_, server_.next_page_++, stream_.release_socket())->accept(request);
      return;
    }
    if (request.method() != http::verb::get && request.method() != http::verb::post)
      return answer({405, "text/plain", "expected GET or POST", ""}, keeps);
    const std::size_t question = target.find('?');
    asked_ = {};
    asked_.method = text_of(request.method_string());
    asked_.path =
        target.substr(folder.size(), question == std::string::npos ? question : question - folder.size());
    if (question != std::string::npos) asked_.query = target.substr(question + 1);
    read_body();
  }

  void read_body() {
    const WebOptions& options = server_.options_;
    const bool uploads = asked_.method == "POST" && asked_.path == options.upload;
    const std::size_t limit = uploads ? options.max_upload : options.max_body;
    if (parser_->content_length().value_or(0) > limit) return answer(too_large(), false);
    parser_->body_limit(limit);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error == http::error::body_limit) return self->answer(too_large(), false);
      if (!error) self->handle();
    });
  }

  void handle() {
    const bool keeps = parser_->get().keep_alive();
    asked_.body = std::move(parser_->get().body());
    stream_.expires_never();
    server_.handlers_.request(std::move(asked_), [self = shared_from_this(), keeps](WebReply reply) {
      asio::post(self->server_.context_,
                 [self, keeps, reply = std::move(reply)] { self->answer(reply, keeps); });
    });
  }

  void answer(const WebReply& reply, bool keeps) {
    response_ = {};
    response_.version(11);
    response_.result(reply.status);
    response_.set(http::field::content_type, reply.type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set(
        "Content-Security-Policy",
        "default-src 'self'; script-src 'self' 'nonce-" + server_.secret_ +
            "'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; frame-ancestors 'none'; "
            "base-uri 'none'; form-action 'none'");
    if (!reply.download.empty())
      response_.set(http::field::content_disposition, "attachment; filename=\"" + reply.download + "\"");
    response_.keep_alive(keeps);
    response_.body() = reply.body;
    const std::string mark = "{{nonce}}";
    if (const std::size_t at = response_.body().find(mark);
        reply.type.compare(0, 9, "text/html") == 0 && at != std::string::npos)
      response_.body().replace(at, mark.size(), server_.secret_);
    response_.prepare_payload();
    stream_.expires_after(request_timeout);
    http::async_write(stream_, response_, [self = shared_from_this(), keeps](error_code error, std::size_t) {
      if (error) return;
      if (keeps) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Implementation& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  WebRequest asked_;
  http::response<http::string_body> response_;
};

void WebServer::Implementation::accept() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (!error) {
      // A step of a drag is answered by two short messages; the second must not wait for the page's
      // acknowledgement of the first.
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Connection>(*this, std::move(socket))->read();
    }
    if (error != asio::error::operation_aborted) accept();
  });
}

void WebServer::Implementation::send(PageId page, Outgoing message) {
  asio::post(context_, [this, page, message = std::move(message)]() mutable {
    if (const auto found = pages_.find(page); found != pages_.end()) found->second->send(std::move(message));
  });
}

void WebServer::Implementation::close(PageId page, std::string reason) {
  asio::post(context_, [this, page, reason = std::move(reason)] {
    if (const auto found = pages_.find(page); found != pages_.end()) found->second->close(reason);
  });
}

WebServer::WebServer(WebOptions options, WebHandlers handlers)
    : implementation_(std::make_shared<Implementation>(options, std::move(handlers))) {}

WebServer::~WebServer() = default;

std::string WebServer::address() const {
  return implementation_->address();
}

void WebServer::run() {
  implementation_->run();
}

void WebServer::send_text(PageId page, std::string text, std::uint32_t replaces) {
  implementation_->send(page, {std::make_shared<const std::string>(std::move(text)), false, replaces});
}

void WebServer::send_bytes(PageId page, std::shared_ptr<const std::string> bytes, std::uint32_t replaces) {
  implementation_->send(page, {std::move(bytes), true, replaces});
}

void WebServer::close(PageId page, std::string reason) {
  implementation_->close(page, std::move(reason));
}

}  // namespace stackabilization::apps
