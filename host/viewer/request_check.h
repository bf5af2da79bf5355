#pragma once
/// Which requests a view answers: those of its own page, on this machine.
#include <cstdint>
#include <optional>
#include <string>

namespace triad {

/// Bytes of a request's body at most.
inline constexpr std::uint64_t most_body = 16384;

/// What of a request decides. Header fields that are not there are empty.
struct RequestHead {
    std::string method, path, host, origin, fetch_site, content_type, content_length, transfer_encoding;
};

struct Refusal {
    int status = 400;
    std::string sentence;
};

/// Where a view is served.
struct ViewPlace {
    unsigned port = 0;
    std::string token;  ///< the first folder of every path, which nobody guesses

    std::string url() const;
};

/// Why a request is not answered; none: it is.
std::optional<Refusal> refusal_of(const RequestHead& request, const ViewPlace& place);

/// 32 hexadecimal digits that nobody foresees.
std::string random_token();

}  // namespace triad
