#include "viewer/request_check.h"

#include <algorithm>
#include <cctype>
#include <random>

#include "base/text.h"

namespace triad {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

/// Another name that leads here is another page's trick (DNS rebinding).
bool is_here(const std::string& host, const ViewPlace& place) {
    const std::string port = ":" + std::to_string(place.port);
    const std::string name = lower(host);
    return name == "127.0.0.1" + port || name == "localhost" + port;
}

bool is_own_origin(const std::string& origin, const ViewPlace& place) {
    const std::string scheme = "http://";
    return origin.starts_with(scheme) && is_here(origin.substr(scheme.size()), place);
}

bool is_too_long(const std::string& content_length) {
    const bool is_number = !content_length.empty() && content_length.size() <= 9 &&
                           content_length.find_first_not_of("0123456789") == std::string::npos;
    return !is_number || std::stoul(content_length) > most_body;
}

}  // namespace

std::string ViewPlace::url() const { return "http://127.0.0.1:" + std::to_string(port) + "/" + token + "/"; }

std::optional<Refusal> refusal_of(const RequestHead& r, const ViewPlace& place) {
    if (!is_here(r.host, place))
        return Refusal{403, "The host of a view is 127.0.0.1 or localhost, and its port."};
    const std::string root = "/" + place.token + "/";
    if (!r.path.starts_with(root))
        return Refusal{404, "There is no such page. The view's address is what triad printed."};
    const bool is_reading = r.method == "GET" || r.method == "HEAD";
    if (!is_reading && r.method != "POST") return Refusal{405, "A view answers GET and POST."};
    if (!r.origin.empty() && !is_own_origin(r.origin, place))
        return Refusal{403, "Another page asks: only the view's own page may."};
    // A link may lead to the page itself from anywhere.
    const bool is_own = r.fetch_site.empty() || r.fetch_site == "same-origin" || r.fetch_site == "none";
    if (!is_own && !(is_reading && r.path == root))
        return Refusal{403, "Another site asks: only the view's own page may."};
    if (!r.transfer_encoding.empty()) return Refusal{411, "The length of the body is not said."};
    if (is_reading && (r.content_length.empty() || r.content_length == "0")) return std::nullopt;
    if (is_too_long(r.content_length)) return Refusal{413, "The body is too long."};
    if (is_reading) return Refusal{400, "What only reads has no body."};
    if (lower(r.content_type).substr(0, r.content_type.find(';')) != "application/json")
        return Refusal{415, "A change is application/json."};
    return std::nullopt;
}

std::string random_token() {
    std::random_device random;
    std::string token;
    for (int i = 0; i < 4; ++i) token += format("%08x", unsigned(random()));
    return token;
}

}  // namespace triad
