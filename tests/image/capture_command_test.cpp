// From a render to a capture and back: the same bits on the same device, and faults that are told.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/files.h"
#include "base/temporary_folder.h"
#include "capture/capture.h"
#include "io/io.h"
#include "json_schema.h"
#include "program.h"

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;
using triad::TemporaryFolder;

Outcome run_replay(const std::string& arguments, const std::string& before = "") {
    return run_program(TRIAD_REPLAY, arguments, before);
}

std::string path_of(const TemporaryFolder& folder, const std::string& name) {
    return (folder.path() / name).string();
}

/// The report of a replay.
Json report_of(const std::string& path) { return Json::parse(bytes_of(path)); }

/// Captures with these options and expects the same bits of two replays.
Json round_trip(const TemporaryFolder& folder, const std::string& options) {
    const std::string file = path_of(folder, "a.capture"), json = path_of(folder, "a.json");
    const Outcome captured = run_triad("capture " + options + " -o " + file);
    EXPECT_EQ(captured.exit, 0) << options << captured.output;
    const Outcome replayed = run_replay(file + " --repeat 1 --json " + json);
    EXPECT_EQ(replayed.exit, 0) << options << replayed.output;
    EXPECT_NE(replayed.output.find("the captured bits"), std::string::npos) << replayed.output;
    return fs::exists(json) ? report_of(json) : Json();
}

const std::string small_built_in = "--size 24x16 --spp 2";

/// What a table says of a kernel.
Json row_of(const Json& report, const std::string& kernel) {
    for (const Json& row : report.at("rows"))
        if (row.at("kernel") == kernel) return row;
    ADD_FAILURE() << "no row of " << kernel;
    return Json{{"launches", 0}, {"items", 0}};
}

}  // namespace

TEST(CaptureCommand, replays_bit_for_bit_with_every_driver) {
    const TemporaryFolder folder;
    const Json mega = round_trip(folder, small_built_in + " --driver mega --bins 2x1");
    EXPECT_EQ(mega.at("schema"), "triad.replay/1");
    EXPECT_TRUE(mega.at("verification").at("same_bits"));
    EXPECT_EQ(mega.at("verification").at("rule"), "bits");
    EXPECT_GE(row_of(mega, "trace_paths").at("items"), 24 * 16);
    const Json wave = round_trip(folder, small_built_in + " --driver wave");
    EXPECT_GE(row_of(wave, "trace_wave").at("launches"), 1);
    const Json stages = round_trip(folder, small_built_in + " --driver wave-stages --format bvh4");
    EXPECT_GT(row_of(stages, "wave_end_paths").at("launches"), 8);
    double share = 0;
    for (const Json& row : stages.at("rows")) share += row.at("share").get<double>();
    EXPECT_NEAR(share, 1, 1e-9);
}

TEST(CaptureCommand, a_replay_reports_what_a_profile_does_and_what_became_slower) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), json = path_of(folder, "a.json"),
                      page = path_of(folder, "page");
    ASSERT_EQ(run_triad("capture " + small_built_in + " --driver wave-stages -o " + file).exit, 0);
    const Outcome replayed = run_replay(file + " --repeat 2 --json " + json + " -o " + page);
    ASSERT_EQ(replayed.exit, 0) << replayed.output;
    EXPECT_NE(replayed.output.find("of the roof"), std::string::npos) << replayed.output;
    expect_schema("replay", json);
    Json report = report_of(json);
    const Json row = row_of(report, "wave_intersect_edges");
    EXPECT_GT(row.at("roofline_share"), 0);
    EXPECT_LE(row.at("roofline_share"), 1);
    EXPECT_EQ(row.at("ms_of_runs").size(), 2u);
    EXPECT_LE(row.at("units_per_item"), 1.01);  // counted on other samples
    EXPECT_EQ(report.at("devices")[0].at("path_driver"), "wave-stages");
    const std::string html = bytes_of(page + "/index.html");
    for (const char* part :
         {"wave_intersect_edges", "data:image/svg+xml", "How long the lists are", "</html>"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    for (const char* outside : {"src=\"http", "href=\"http", "url(http", "<script"})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    for (Json& each : report["rows"])
        for (Json& ms : each["ms_of_runs"]) ms = 0.1 * ms.get<double>();
    std::ofstream(json) << report;
    EXPECT_EQ(run_replay(file + " --repeat 2 --against " + json).exit, 7);
    const Outcome early = run_replay(file + " --repeat 1 --against " + json);
    EXPECT_EQ(early.exit, 1) << early.output;
    EXPECT_NE(early.output.find("need two or more"), std::string::npos) << early.output;
    EXPECT_EQ(early.output.find("median ms"), std::string::npos) << early.output;  // nothing was measured
    EXPECT_EQ(run_replay(file + " --against '" TRIAD_SCENES "/suite/glass.glb'").exit, 2);
    EXPECT_EQ(run_replay(file + " --repeat 2 --single-kernel wave_end_paths --against " + json).exit, 1);
    EXPECT_EQ(run_replay(file + " --repeat 0 --against " + json).exit, 1);
    EXPECT_EQ(run_replay(file + " --json " + file).exit, 1);
}

TEST(CaptureCommand, replays_photons_and_textured_environments_bit_for_bit) {
    const TemporaryFolder folder;
    const std::string scenes = TRIAD_SCENES;
    const Json photons = round_trip(
        folder, scenes + "/spectral/water_glass.glb --size 16x16 --spp 2 --integrator photons --photons 500");
    EXPECT_GE(row_of(photons, "trace_photons").at("launches"), 2);  // with each sample
    EXPECT_GE(row_of(photons, "sort_photons").at("items"), 1000);
    for (const char* scene : {"/subpixel/page.glb", "/suite/garden.glb"})
        round_trip(folder, scenes + scene + " --size 16x16 --spp 1");
}

TEST(CaptureCommand, the_film_is_that_of_a_render) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), film = path_of(folder, "a.film");
    ASSERT_EQ(run_triad("capture " + small_built_in + " --driver mega -o " + file).exit, 0);
    ASSERT_EQ(run_triad("render " + small_built_in + " --driver mega --film " + film).exit, 0);
    const triad::Film rendered = triad::load_film(film);
    const triad::Capture capture = triad::read_capture(file);
    using What = triad::CapturedArray::What;
    const auto expect_same = [&](What what, const auto& values) {
        for (const triad::CapturedArray& array : capture.film)
            if (array.what == what) {
                ASSERT_EQ(array.content->size(), values.size() * sizeof values[0]);
                EXPECT_EQ(std::memcmp(array.content->data(), values.data(), array.content->size()), 0);
            }
    };
    expect_same(What::sums, rendered.sums);
    expect_same(What::half_sums, rendered.half_sums);
    expect_same(What::samples, rendered.samples);
}

TEST(CaptureCommand, changed_kernels_are_found_out_by_bits_and_by_the_film) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), kernels = path_of(folder, "kernels"),
                      json = path_of(folder, "a.json");
    ASSERT_EQ(run_triad("capture " + small_built_in + " --driver mega -o " + file).exit, 0);
    ASSERT_EQ(run_replay(file + " --extract " + kernels).exit, 0);
    const Outcome same = run_replay(file + " --repeat 0 --kernels " + kernels);
    EXPECT_EQ(same.exit, 0) << same.output;
    EXPECT_NE(same.output.find("the captured bits"), std::string::npos) << same.output;
    EXPECT_NE(same.output.find("The programs are as captured"), std::string::npos) << same.output;

    // The planted fault: one percent brighter, all of it.
    const fs::path changed = fs::path(kernels) / "common/film.h";
    std::string text = bytes_of(changed);
    const std::string line = "const float q = x * quanta;";
    const std::size_t at = text.find(line);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, line.size(), "const float q = x * quanta * 1.01f;");
    triad::write_file(changed, text);
    const Outcome by_bits = run_replay(file + " --repeat 0 --kernels " + kernels);
    EXPECT_EQ(by_bits.exit, 7) << by_bits.output;
    EXPECT_NE(by_bits.output.find("path/mega.cl is not as captured"), std::string::npos) << by_bits.output;
    const Outcome by_film =
        run_replay(file + " --repeat 0 --verify film --kernels " + kernels + " --json " + json);
    EXPECT_EQ(by_film.exit, 7) << by_film.output;
    EXPECT_NE(by_film.output.find("brighter in the median"), std::string::npos) << by_film.output;
    const Json verification = report_of(json).at("verification");
    EXPECT_FALSE(verification.at("ok"));
    EXPECT_NEAR(verification.at("bias").get<double>(), 0.01, 0.001);
}

TEST(CaptureCommand, one_kernel_alone_finds_its_work_again_each_time) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), json = path_of(folder, "a.json");
    ASSERT_EQ(run_triad("capture " + small_built_in + " --driver wave-stages -o " + file).exit, 0);
    const Outcome alone =
        run_replay(file + " --repeat 3 --single-kernel wave_intersect_edges --launch 2 --json " + json);
    EXPECT_EQ(alone.exit, 0) << alone.output;
    const Json report = report_of(json);
    ASSERT_EQ(report.at("rows").size(), 1u);
    EXPECT_EQ(report.at("rows")[0].at("launches"), 1);
    const Outcome unknown = run_replay(file + " --single-kernel nothing");
    EXPECT_EQ(unknown.exit, 1) << unknown.output;
    EXPECT_NE(unknown.output.find("wave_end_paths"), std::string::npos) << unknown.output;
    EXPECT_EQ(run_replay(file + " --single-kernel wave_end_paths --launch 100000").exit, 1);
}

TEST(CaptureCommand, tuning_changes_no_bit) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), json = path_of(folder, "a.json");
    ASSERT_EQ(run_triad("capture --size 16x8 --spp 1 --driver mega -o " + file).exit, 0);
    const Outcome tuned = run_replay(file + " --repeat 1 --tune --json " + json);
    EXPECT_EQ(tuned.exit, 0) << tuned.output;
    const Json report = report_of(json);
    EXPECT_GT(report.at("sizes").size(), 3u);
    unsigned best = 0;
    for (const Json& size : report.at("sizes")) best += size.at("best").get<bool>();
    EXPECT_EQ(best, 1u);
    EXPECT_EQ(report.at("tuned_rows")[0].at("kernel"), "trace_paths");
}

TEST(CaptureCommand, a_replay_proves_its_device_first_when_asked) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture"), json = path_of(folder, "a.json");
    ASSERT_EQ(run_triad("capture --size 8x8 --spp 1 --driver mega -o " + file).exit, 0);
    const Outcome checked = run_replay(file + " --repeat 0 --check --json " + json);
    EXPECT_EQ(checked.exit, 0) << checked.output;
    EXPECT_GT(report_of(json).at("check").size(), 10u);
}

TEST(CaptureCommand, what_is_missing_is_said) {
    const TemporaryFolder folder;
    const std::string file = path_of(folder, "a.capture");
    EXPECT_EQ(run_triad("capture").exit, 1);
    EXPECT_EQ(run_triad("capture --error 0.1 -o " + file).exit, 1);
    EXPECT_EQ(run_replay("").exit, 1);
    EXPECT_EQ(run_replay(path_of(folder, "absent.capture")).exit, 2);
    ASSERT_EQ(run_triad("capture --size 8x8 --spp 1 --driver mega -o " + file).exit, 0);
    const Outcome no_driver = run_replay(file, "OCL_ICD_VENDORS=/nonexistent");
    EXPECT_EQ(no_driver.exit, 5) << no_driver.output;
    EXPECT_NE(no_driver.output.find("OpenCL"), std::string::npos) << no_driver.output;
    fs::resize_file(file, fs::file_size(file) - 7);
    const Outcome cut = run_replay(file);
    EXPECT_EQ(cut.exit, 2) << cut.output;
    EXPECT_NE(cut.output.find("ends early"), std::string::npos) << cut.output;
}
