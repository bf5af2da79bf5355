#include "pack/albedo_tables.h"

#include <iterator>

#include "kernels/types.h"

namespace triad {

const std::vector<float>& albedo_tables() {
    static constexpr float values[] = {
#include "albedo_tables.inc"
    };
    static_assert(std::size(values) == ALBEDO_FLOATS);
    static const std::vector<float> tables(std::begin(values), std::end(values));
    return tables;
}

}  // namespace triad
