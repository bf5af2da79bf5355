#pragma once
/// Whole numbers of untrusted JSON.
#include <type_traits>

namespace triad {

/// The number, wrapped where it is larger than its type. Throws nlohmann's type_error where it is none, is
/// written as a fraction, or is negative for an unsigned type; nlohmann's own conversions cast 1e300, which
/// is undefined.
template <class Number, class Json>
Number whole_number(const Json& json) {
    using Stored = std::conditional_t<std::is_signed_v<Number>, typename Json::number_integer_t,
                                      typename Json::number_unsigned_t>;
    return Number(json.template get_ref<const Stored&>());
}

}  // namespace triad
