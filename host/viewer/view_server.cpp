#include "viewer/view_server.h"

#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <charconv>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "page/page_style.h"
#include "viewer/magnifier.h"
#include "viewer/page_files.h"

namespace triad {
namespace {

/// Connections that are answered at once; further ones wait, some of them in the kernel.
constexpr std::size_t most_connections = 12;
/// Pages that follow the state at once, each of which holds a connection.
constexpr int most_followers = 6;
/// A follower that went away is noticed after so many seconds.
constexpr double ping_seconds = 5, file_seconds = 60;

/// A pool that takes no more work than it has threads: accepting connections waits.
class BoundedPool : public httplib::TaskQueue {
  public:
    explicit BoundedPool(std::size_t threads) : pool_(threads), free_(threads) {}

    /// Versions of the library differ in what it returns.
    using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));
    Enqueued enqueue(std::function<void()> work) override {
        {
            std::unique_lock lock(mutex_);
            freed_.wait(lock, [this] { return free_ > 0; });
            --free_;
        }
        return pool_.enqueue([this, work = std::move(work)] {
            work();
            const std::lock_guard lock(mutex_);
            ++free_;
            freed_.notify_one();
        });
    }
    void shutdown() override { pool_.shutdown(); }

  private:
    httplib::ThreadPool pool_;
    std::mutex mutex_;
    std::condition_variable freed_;
    std::size_t free_;
};

const char* type_of(const std::string& extension) {
    if (extension == ".html") return "text/html; charset=utf-8";
    if (extension == ".css") return "text/css; charset=utf-8";
    if (extension == ".js") return "text/javascript; charset=utf-8";
    if (extension == ".png") return "image/png";
    if (extension == ".jpg") return "image/jpeg";
    return "application/octet-stream";
}

std::string extension_of(const std::string& name) {
    const auto dot = name.rfind('.');
    return dot == std::string::npos ? "" : name.substr(dot);
}

void say(httplib::Response& response, int status, const std::string& sentence) {
    response.status = status;
    response.set_content(sentence, "text/plain; charset=utf-8");
}

/// A whole number from lo to hi among the query's; `otherwise` where it is not there. Throws Error(usage).
unsigned number_in(const httplib::Request& request, const char* name, unsigned lo, unsigned hi,
                   std::optional<unsigned> otherwise = {}) {
    if (!request.has_param(name) && otherwise) return *otherwise;
    const std::string text = request.get_param_value(name);
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < lo || value > hi)
        throw Error(Exit::usage, format("%s: expected a whole number from %u to %u.", name, lo, hi));
    return value;
}

void send_pixels(httplib::Response& response, std::shared_ptr<const ViewFrame> frame) {
    response.set_header(
        "X-Triad-Frame",
        format("%llu %u %u %u %u %u %u %u %u %u", static_cast<unsigned long long>(frame->number),
               frame->full_width, frame->full_height, frame->x, frame->y, frame->width, frame->height,
               frame->columns, frame->rows, unsigned(frame->partial)));
    const std::size_t size = frame->rgba.size();
    response.set_content_provider(
        size, "application/octet-stream",
        [frame = std::move(frame)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            return sink.write(reinterpret_cast<const char*>(frame->rgba.data()) + offset, length);
        });
}

}  // namespace

struct ViewServer::State {
    Exchange& exchange;
    ViewPlace place;
    httplib::Server server;
    std::atomic<int> followers = 0;
    std::atomic<bool> has_ended = false;
    std::thread thread;

    State(Exchange& e, unsigned port) : exchange(e) {
        place.token = random_token();
        server.new_task_queue = [] { return new BoundedPool(most_connections); };
        // One request a connection: none is kept by a page that asks for nothing, and no body that was not
        // read is taken for a request.
        server.set_keep_alive_max_count(1);
        server.set_payload_max_length(most_body);
        server.set_tcp_nodelay(true);
        // The library's own also let another process share the port.
        server.set_socket_options([](socket_t socket) {
            const int yes = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        server.set_default_headers(
            {{"Content-Security-Policy",
              "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
              "data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
             {"X-Content-Type-Options", "nosniff"},
             {"Referrer-Policy", "no-referrer"},
             {"Cross-Origin-Resource-Policy", "same-origin"},
             {"Cross-Origin-Opener-Policy", "same-origin"},
             {"Cache-Control", "no-store"}});
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            return check(request, response);
        });
        server.set_exception_handler(
            [](const httplib::Request&, httplib::Response& response, std::exception_ptr error) {
                try {
                    std::rethrow_exception(error);
                } catch (const Error& e) {
                    say(response, 400, e.what());
                } catch (const std::exception& e) {
                    say(response, 500, e.what());
                }
            });
        server.Get("/.*", [this](const httplib::Request& q, httplib::Response& r) { get(q, r); });
        server.Post("/.*", [this](const httplib::Request& q, httplib::Response& r) { post(q, r); });
        bind(port);
        thread = std::thread([this] {
            server.listen_after_bind();
            has_ended = true;
        });
        // Before that, stop() would do nothing.
        while (!server.is_running() && !has_ended) std::this_thread::yield();
    }

    void bind(unsigned port) {
        const char* const here = "127.0.0.1";
        const int bound = port == 0                              ? server.bind_to_any_port(here)
                          : server.bind_to_port(here, int(port)) ? int(port)
                                                                 : -1;
        if (bound < 0)
            throw Error(Exit::usage, "--port " + std::to_string(port) +
                                         ": it cannot be listened at; another program may. Give another, or "
                                         "leave it out for any that is free.");
        place.port = unsigned(bound);
    }

    httplib::Server::HandlerResponse check(const httplib::Request& q, httplib::Response& response) {
        RequestHead head{q.method, q.path, "", "", "", "", "", ""};
        if (q.get_header_value_count("Host") == 1) head.host = q.get_header_value("Host");
        head.origin = q.get_header_value("Origin");
        head.fetch_site = q.get_header_value("Sec-Fetch-Site");
        head.content_type = q.get_header_value("Content-Type");
        head.content_length = q.get_header_value("Content-Length");
        head.transfer_encoding = q.get_header_value("Transfer-Encoding");
        const auto refusal = refusal_of(head, place);
        if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
        say(response, refusal->status, refusal->sentence);
        return httplib::Server::HandlerResponse::Handled;
    }

    std::string name_in(const httplib::Request& q) const { return q.path.substr(place.token.size() + 2); }

    void get(const httplib::Request& q, httplib::Response& r) {
        const std::string name = name_in(q);
        if (name == "events") return follow(r);
        if (name == "frame" || name == "region") {
            auto frame = exchange.frame(name == "region");
            if (frame) return send_pixels(r, std::move(frame));
            r.status = 204;
            return;
        }
        if (name == "magnifier") return magnify(q, r);
        if (name.starts_with("save/")) return save(name.substr(5), r);
        if (name == "style.css") return r.set_content(page_style, type_of(".css"));
        const auto found = page_files().find(name.empty() ? "index.html" : name);
        if (found == page_files().end()) return say(r, 404, "There is no such file.");
        r.set_content(found->second.data(), found->second.size(), type_of(extension_of(found->first)));
    }

    void post(const httplib::Request& q, httplib::Response& r) {
        if (name_in(q) != "change") return say(r, 404, "There is nothing of that name to change.");
        if (!exchange.post(parse_change(q.body))) return say(r, 503, "Too many changes wait already.");
        r.status = 204;
    }

    void follow(httplib::Response& r) {
        if (followers.fetch_add(1) >= most_followers) {
            --followers;
            return say(r, 503, "Too many pages show this view already: close one.");
        }
        r.set_chunked_content_provider(
            "text/event-stream",
            [this, seen = std::uint64_t(0)](std::size_t, httplib::DataSink& sink) mutable {
                if (exchange.closed()) return false;
                const auto state = exchange.state_after(seen, ping_seconds);
                if (state) seen = state->number;
                const std::string event = state ? "data: " + state->json + "\n\n" : ":\n\n";
                return sink.write(event.data(), event.size());
            },
            [this](bool) { --followers; });
    }

    void magnify(const httplib::Request& q, httplib::Response& r) {
        const unsigned x = number_in(q, "x", 0, 65535), y = number_in(q, "y", 0, 65535),
                       across = number_in(q, "across", 1, 64, 11), zoom = number_in(q, "zoom", 1, 64, 24);
        auto frame = exchange.frame(true);
        const auto covers = [&](const ViewFrame& f) {
            return x >= f.x && y >= f.y && x - f.x < f.width && y - f.y < f.height;
        };
        if (!frame || !covers(*frame)) frame = exchange.frame(false);
        if (!frame || !covers(*frame)) {
            r.status = 204;
            return;
        }
        send_pixels(r, std::make_shared<const ViewFrame>(magnified(*frame, x, y, across, zoom)));
    }

    void save(const std::string& name, httplib::Response& r) {
        const std::string extension = extension_of(name);
        bool is_known = false;
        for (const char* known : {".png", ".jpg", ".exr", ".triadfilm"}) is_known |= extension == known;
        if (!is_known) return say(r, 404, "Pictures are saved as .png, .jpg or .exr, films as .triadfilm.");
        const auto bytes = exchange.file(extension, file_seconds);
        if (!bytes) return say(r, 503, "The picture is not there yet: try again.");
        r.set_header("Content-Disposition", "attachment");
        r.set_content(bytes->data(), bytes->size(), type_of(extension));
    }
};

ViewServer::ViewServer(Exchange& exchange, unsigned port) : state_(std::make_unique<State>(exchange, port)) {}

ViewServer::~ViewServer() {
    state_->exchange.close();
    state_->server.stop();
    state_->thread.join();
}

const ViewPlace& ViewServer::place() const { return state_->place; }

}  // namespace triad
