#include "report/report.h"

#include <ctime>

namespace triad {

Json spp_json(const SampleNumbers& numbers) {
    return numbers.least == numbers.most ? Json(numbers.least) : Json(numbers.mean);
}

std::string date_words() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
    return text;
}

}  // namespace triad
