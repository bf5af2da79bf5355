#include "report/report.h"

namespace triad {

Json spp_json(const SampleNumbers& numbers) {
    return numbers.least == numbers.most ? Json(numbers.least) : Json(numbers.mean);
}

}  // namespace triad
