#include "check/verdict.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/without_details.h"
#include "trace/node_format.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr const char* schema = "triad.verdict/1";

std::string sentence(const Verdict& verdict, const DeviceInfo& device) {
    std::string names;
    for (const std::string& name : verdict.wrong) names += (names.empty() ? "" : ", ") + name;
    return device.name + " with driver " + device.driver + " computes wrong answers: " + names + ".";
}

}  // namespace

fs::path verdict_path(const DeviceInfo& device, BvhFormat format, PathDriverKind driver) {
    return kept_path(device, std::string("checked/") + name_of(driver) + "-" + name_of(format));
}

std::vector<CheckCase> first_cases() {
    return cases_of(CheckLevel::quick, {"L2", "M10", "C18d", "C1", "C2", "C3", "C7", "C11c", "C17", "R1",
                                        "C4", "C23", "C20", "D4", "D2"});
}

std::optional<Verdict> load_verdict(const DeviceInfo& device, BvhFormat format, PathDriverKind driver) {
    const fs::path path = verdict_path(device, format, driver);
    std::ifstream file(path);
    if (path.empty() || !file) return {};
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object() || json.value("schema", nlohmann::json()) != schema || !json.contains("wrong"))
        return {};
    Verdict verdict;
    if (!json["wrong"].is_array()) return {};
    for (const auto& name : json["wrong"]) {
        if (!name.is_string()) return {};
        verdict.wrong.push_back(name);
    }
    return verdict;
}

void keep_verdict(const DeviceInfo& device, BvhFormat format, const Verdict& verdict, PathDriverKind driver) {
    const fs::path path = verdict_path(device, format, driver);
    if (path.empty()) return;
    const nlohmann::json json{{"schema", schema},          {"device", device.name},
                              {"driver", device.driver},   {"platform", device.platform},
                              {"format", name_of(format)}, {"wrong", verdict.wrong}};
    try {
        fs::create_directories(path.parent_path());
        write_file(path, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const std::exception& error) {
        warn(std::string("The verdict on this device is not kept: ") + error.what());
    }
}

std::optional<Verdict> verdict_of(const std::vector<CheckResult>& results) {
    Verdict verdict;
    bool lacked_memory = false;
    for (const CheckResult& r : results) {
        lacked_memory |= r.lacked_memory;
        if (r.ok == false && !r.lacked_memory) verdict.wrong.push_back(r.name);
    }
    if (lacked_memory && verdict.wrong.empty()) return {};
    return verdict;
}

std::optional<Verdict> ensure_checked(Device& device) {
    const BvhFormat format = format_of(device);
    if (const auto kept = load_verdict(device.info(), format, path_driver_of(device))) return *kept;
    inform("First use of " + device.info().name +
           " with this driver: a few seconds to check that its answers are right.");
    const WithoutDetails quiet;
    const std::optional<Verdict> verdict =
        verdict_of(run_cases(device, first_cases(), CheckLevel::quick, [](const CheckResult&) {}));
    if (verdict) keep_verdict(device.info(), format, *verdict, path_driver_of(device));
    return verdict;
}

void require_right(const Verdict& verdict, const DeviceInfo& device, bool force) {
    if (verdict.wrong.empty()) return;
    if (force) return warn(sentence(verdict, device) + " The picture may be wrong.");
    throw Error(Exit::device,
                sentence(verdict, device) +
                    " triad check says more; choose another --device, or --force to render with it.");
}

void require_right(Device& device, bool force) {
    if (const std::optional<Verdict> verdict = ensure_checked(device))
        return require_right(*verdict, device.info(), force);
    const std::string lack =
        device.info().name + " has too little memory to check that its answers are right";
    if (force) return warn(lack + ". The picture may be wrong.");
    throw Error(Exit::memory, lack + "; --force renders without the check.");
}

}  // namespace triad
