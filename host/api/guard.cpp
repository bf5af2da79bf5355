#include "api/guard.h"

namespace triad::api {

std::recursive_mutex& calls() {
    static std::recursive_mutex mutex;
    return mutex;
}

}  // namespace triad::api
