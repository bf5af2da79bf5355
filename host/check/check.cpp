#include "check/check.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "check/cases.h"
#include "check/measurements.h"

namespace triad {

std::size_t Check::count(std::size_t full, std::size_t least) const {
    const unsigned shift = level == CheckLevel::full       ? 0
                           : level == CheckLevel::standard ? 2
                           : level == CheckLevel::quick    ? 4
                                                           : 10;
    return std::max(std::min(full, least), full >> shift);
}

CheckResult Check::result() const {
    CheckResult r{.value = value_, .bound = bound_, .ok = failures_.empty(), .what = what_};
    // An answer that is plainly wrong is said by how many there are, unless a measurement is beyond its
    // bound.
    if (wrong_ > 0 && worst_badness_ <= 1)
        r.value = static_cast<double>(wrong_), r.bound = 0, r.what = "wrong answers";
    r.failures = failures_;
    return r;
}

const std::vector<CheckCase>& function_cases() {
    static const std::vector<CheckCase> cases = [] {
        std::vector<CheckCase> all;
        for (const auto add : {add_layout,
                               add_maths,
                               add_random,
                               add_sampling,
                               add_traversal,
                               add_traversal_input,
                               add_traversal_reference,
                               add_any_bits,
                               add_ggx,
                               add_bsdf,
                               add_bsdf_energy,
                               add_bsdf_layers,
                               add_bsdf_grazing,
                               add_light_samplers,
                               add_light_tree,
                               add_lights,
                               add_near_lights,
                               add_spectral,
                               add_light_spectra,
                               add_film,
                               add_photons,
                               add_textures})
            add(all);
        return all;
    }();
    return cases;
}

const std::vector<CheckCase>& traversal_cases() {
    static const std::vector<CheckCase> cases = [] {
        std::vector<CheckCase> all;
        for (const auto add : {add_traversal, add_traversal_input, add_traversal_reference, add_any_bits})
            add(all);
        return all;
    }();
    return cases;
}

const std::vector<CheckCase>& picture_cases() {
    static const std::vector<CheckCase> cases = [] {
        std::vector<CheckCase> all;
        for (const auto add : {add_invariance, add_energy, add_radiometry, add_spectral_pictures,
                               add_hard_pictures, add_photon_pictures, add_texture_pictures})
            add(all);
        return all;
    }();
    return cases;
}

std::vector<CheckCase> cases_of(CheckLevel level, const std::vector<std::string>& ids) {
    std::vector<CheckCase> all = function_cases();
    all.insert(all.end(), picture_cases().begin(), picture_cases().end());
    if (ids.empty()) {
        std::erase_if(all, [&](const CheckCase& c) { return c.level > std::max(level, CheckLevel::quick); });
        return all;
    }
    std::vector<CheckCase> chosen;
    for (const std::string& id : ids) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const CheckCase& c) { return c.id == id; });
        if (found == all.end())
            throw Error(Exit::usage, "There is no case " + id + "; triad check --list prints all of them.");
        chosen.push_back(*found);
    }
    return chosen;
}

CheckResult run_case(Device& device, const CheckCase& each, CheckLevel level) {
    CheckResult result;
    if (each.run) {
        const auto start = std::chrono::steady_clock::now();
        Check check(device, level);
        try {
            each.run(check);
            result = check.result();
        } catch (const Error& error) {
            result.ok = false;
            result.failures = {error.what()};
            result.lacked_memory = error.exit() == Exit::memory;
        }
        result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    } else {
        result.what = each.absent;
    }
    result.name = each.name();
    return result;
}

std::vector<CheckResult> run_cases(Device& device, const std::vector<CheckCase>& cases, CheckLevel level,
                                   const std::function<void(const CheckResult&)>& report) {
    std::vector<CheckResult> results;
    for (const CheckCase& each : cases) {
        results.push_back(run_case(device, each, level));
        report(results.back());
    }
    return results;
}

}  // namespace triad
