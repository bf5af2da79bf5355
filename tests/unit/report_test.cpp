// The report of an error bench: one file, no resource from outside, no name that breaks it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/child_process.h"
#include "base/files.h"
#include "io/io.h"
#include "page/gnuplot.h"
#include "page/html.h"
#include "report/error_pictures.h"
#include "report/error_plots.h"
#include "report/error_report.h"
#include "report/error_words.h"

namespace triad {
namespace {

namespace fs = std::filesystem;

const std::string hostile = "a<script>alert(1)</script> & \"b\" 'c' `touch oops` $HOME";

RgbImage gradient(unsigned width, unsigned height, float brightest) {
    RgbImage image{width, height, {}};
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x)
            for (const float part : {float(x) / width, float(y) / height, 0.5f})
                image.rgb.push_back(brightest * part);
    return image;
}

/// Two scenes, two settings, errors that fall as 1 / spp with some spread; the second setting is twice as
/// fast.
ErrorBench synthetic(const std::string& name) {
    ErrorBench bench;
    bench.repetitions = 5;
    bench.settings = {{"default", "", "device", "1"}, {name, "--roulette 1", "device", "1"}};
    for (const std::string& scene : {std::string("plain scene"), name}) {
        bench.scenes.push_back({scene, "scene.glb --size 48x32", "hash", gradient(48, 32, 1),
                                gradient(48, 32, 1), 1024, 1e-4, 0});
        for (std::size_t s = 0; s < bench.settings.size(); ++s) {
            ErrorCurve curve;
            curve.scene = scene, curve.setting = bench.settings[s].name;
            for (double spp = 1; spp <= 64; spp *= 2) {
                const double error = 0.1 / spp, seconds = 0.01 * spp / (1.0 + double(s));
                curve.points.push_back(
                    {spp, seconds, {error, 0.9 * error, 1.2 * error}, 0.8 * error, 0.1, 3, 0, true});
                for (unsigned repetition = 0; repetition < bench.repetitions; ++repetition)
                    bench.runs.push_back({scene, curve.setting, repetition, repetition, spp, seconds, 1000,
                                          error, error * (0.9 + 0.05 * repetition), error, 0.1, 3, 0});
            }
            curve.slope = Estimate{-0.5, -0.52, -0.48};
            curve.efficiency = Estimate{1000.0 * (1.0 + double(s)), 900, 2500};
            curve.time_ratio = s ? Estimate{0.5, 0.45, 0.55} : Estimate{1, 1, 1};
            curve.equal_relmse = 0.1 / 64;
            curve.picture = curve.display = gradient(48, 32, 0.9f);
            curve.rel_error.assign(48 * 32, 0.02f);
            curve.flip_map.assign(48 * 32, 0.2f);
            bench.curves.push_back(curve);
        }
    }
    return bench;
}

std::string text_of(const fs::path& path) {
    const auto bytes = read_file(path);
    return {bytes.begin(), bytes.end()};
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// A program that Debian calls by one of these names, or nothing.
std::string first_of_path(const std::vector<std::string>& names) {
    const TemporaryFolder folder;
    for (const std::string& name : names)
        if (run_program({name, "--version"}, folder.path() / "out", folder.path() / "log")) return name;
    return "";
}

/// What the page looks like to a browser: its DOM after a script that counts images was added, and its log.
struct Page {
    std::string dom, log;
};
Page open_page(const std::string& browser, const fs::path& report, const fs::path& folder,
               const std::string& window) {
    std::string html = text_of(report);
    const std::string probe =
        "<script>addEventListener('load', () => { const images = [...document.images];"
        "document.body.dataset.decoded = images.filter(i => i.complete && i.naturalWidth > 0).length + ' of "
        "' + images.length;"
        "document.body.dataset.overflow = document.documentElement.scrollWidth - "
        "document.documentElement.clientWidth; })</script>";
    html.insert(html.find("</body>"), probe);
    write_file(folder / "probe.html", html);
    EXPECT_EQ(
        run_program({browser, "--headless", "--no-sandbox", "--disable-gpu",
                     "--user-data-dir=" + (folder / "profile").string(), "--enable-logging=stderr",
                     "--window-size=" + window, "--dump-dom", "file://" + (folder / "probe.html").string()},
                    folder / "dump", folder / "log"),
        0);
    return {text_of(folder / "dump"), text_of(folder / "log")};
}

TEST(HtmlEscape, NoMarkupNoControlsNoBrokenBytes) {
    EXPECT_EQ(html_escape("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
    EXPECT_EQ(html_escape("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80"), "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
    EXPECT_EQ(html_escape(std::string("a\0b\x1b\n", 5)),
              "a\xef\xbf\xbd"
              "b\xef\xbf\xbd ");
    EXPECT_EQ(html_escape("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");  // overlong '/'
    EXPECT_EQ(html_escape("\xe2\x82"), "\xef\xbf\xbd\xef\xbf\xbd");  // cut off
    EXPECT_EQ(html_escape("\xed\xa0\x80"),
              "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");  // half of a surrogate pair
}

TEST(Base64, VectorsOfRfc4648) {
    const auto of = [](std::string_view text) {
        return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(of("\xff\xfe"), "//4=");
}

TEST(FalseColours, EndsMiddleAndWhatIsNoNumber) {
    const TemporaryFolder folder;
    const auto bytes = false_colour_png({-1.0f, 0.0f, 1.0f, 9.0f, std::nanf("")}, 5, 1, {-1, 1, true});
    write_file(folder.path() / "x.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const Picture picture = read_picture(folder.path() / "x.png");
    const auto pixel = [&](std::size_t i) {
        std::vector<int> rgb;
        for (const char* name : {"R", "G", "B"})
            rgb.push_back(int(std::lround(255 * picture.find(name)->values[i])));
        return rgb;
    };
    EXPECT_EQ(pixel(0), (std::vector<int>{5, 48, 97}));
    EXPECT_EQ(pixel(1), (std::vector<int>{247, 247, 247}));
    EXPECT_EQ(pixel(2), (std::vector<int>{103, 0, 31}));
    EXPECT_EQ(pixel(3), pixel(2));
    EXPECT_EQ(pixel(4), (std::vector<int>{0, 0, 0}));
}

TEST(FalseColours, LimitIsRoundAndAboveNinetyNinePercent) {
    std::vector<float> map(1000, 0.03f);
    map[0] = -100, map[1] = INFINITY;
    EXPECT_DOUBLE_EQ(round_limit({&map}), 0.05);
    EXPECT_DOUBLE_EQ(round_limit({}), 1);
    const std::vector<float> zeros(10, 0.0f);
    EXPECT_DOUBLE_EQ(round_limit({&zeros}), 1);
}

TEST(ErrorWords, FasterSlowerSameVoid) {
    ErrorCurve first, other;
    first.setting = "base";
    other.equal_relmse = 0.01;
    other.time_ratio = Estimate{0.5, 0.4, 0.8};
    EXPECT_EQ(verdict_of(other, first).words, "2.00 times as fast as base to relMSE 0.0100 (1.25 to 2.50).");
    other.time_ratio = Estimate{2, 1.5, 3};
    EXPECT_EQ(verdict_of(other, first).words,
              "Takes 2.00 times as long as base to relMSE 0.0100 (1.50 to 3.00).");
    other.time_ratio = Estimate{1.1, 0.9, 1.3};
    EXPECT_NE(verdict_of(other, first).words.find("beyond noise"), std::string::npos);
    other.right = false;
    EXPECT_EQ(verdict_of(other, first).tone, VerdictWords::Tone::bad);
    EXPECT_EQ(verdict_of(other, first).words.find("Void"), 0u);
}

TEST(ErrorWords, ThreeDigits) {
    EXPECT_EQ(digits3(0), "0");
    EXPECT_EQ(digits3(0.0012345), "0.00123");
    EXPECT_EQ(digits3(1.5), "1.50");
    EXPECT_EQ(digits3(45.678), "45.7");
    EXPECT_EQ(digits3(12345), "12300");
    EXPECT_EQ(digits3(-0.00001234), "-1.23e-05");
    EXPECT_EQ(digits3(INFINITY), "infinite");
}

TEST(ErrorPlots, NamesRunNothing) {
    EXPECT_EQ(gnuplot_quoted("it's\n`x`"), "'it\xe2\x80\x99s `x`'");
    if (first_of_path({"gnuplot"}).empty()) GTEST_SKIP() << "gnuplot is not installed (Debian: gnuplot-nox)";
    const TemporaryFolder folder;
    const std::string mark = (folder.path() / "oops").string();
    ErrorBench bench = synthetic("'; system('touch " + mark + "') # `touch " + mark +
                                 "` \"; system(\"touch " + mark + "\")");
    const ErrorPlots plots = draw_error_plots(bench);
    EXPECT_EQ(plots.missing, "");
    EXPECT_EQ(plots.plots.size(), 5u);
    EXPECT_FALSE(fs::exists(mark));
}

TEST(ErrorPlots, ErrorsBelowZeroHaveNoPlace) {
    if (first_of_path({"gnuplot"}).empty()) GTEST_SKIP() << "gnuplot is not installed (Debian: gnuplot-nox)";
    ErrorBench bench = synthetic("b");
    for (ErrorCurve& curve : bench.curves) {
        curve.points.back().relmse = {-1e-6, -1e-5, 1e-6};
        curve.points[2].relmse.low = -1e-3;
    }
    EXPECT_EQ(draw_error_plots(bench).missing, "");
    for (ErrorCurve& curve : bench.curves) {
        curve.points.clear();
        curve.efficiency.reset();
    }
    const ErrorPlots none = draw_error_plots(bench);
    EXPECT_EQ(none.missing, "");
    EXPECT_TRUE(none.plots.empty());
}

TEST(ErrorReport, NeedsNothingFromOutsideAndEscapesNames) {
    const TemporaryFolder folder;
    write_error_report(folder.path(), synthetic(hostile), {hostile, "triad bench " + hostile, "today", {}});
    const std::string html = text_of(folder.path() / "report.html");
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("http:"), std::string::npos);
    EXPECT_EQ(html.find("https:"), std::string::npos);
    EXPECT_EQ(html.find("url("), std::string::npos);
    EXPECT_EQ(html.find("@import"), std::string::npos);
    EXPECT_EQ(count(html, " src=\""), count(html, " src=\"data:"));
    EXPECT_EQ(count(html, " href=\""), count(html, " href=\"data:"));
    EXPECT_GE(count(html, "data:image/png;base64,"), 2u + 4u * 3u);
    EXPECT_GE(count(html, "a&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;b&quot; &#39;c&#39;"), 4u);
    EXPECT_EQ(count(html, "<img"), count(html, "alt=\""));
}

TEST(ErrorReport, WithoutGnuplotTheRestIsWritten) {
    const TemporaryFolder folder;
    const char* const path = std::getenv("PATH");
    const std::string kept = path ? path : "";
    ::setenv("PATH", folder.path().c_str(), 1);
    const auto written = write_error_report(folder.path(), synthetic("b"), {});
    ::setenv("PATH", kept.c_str(), 1);
    ASSERT_EQ(written.size(), 1u);
    const std::string html = text_of(written[0]);
    EXPECT_NE(html.find("gnuplot-nox"), std::string::npos);
    EXPECT_EQ(count(html, "image/svg+xml"), 0u);
    EXPECT_GE(count(html, "data:image/png;base64,"), 2u + 4u * 3u);
}

TEST(ErrorReport, WrongPictureIsVoid) {
    const TemporaryFolder folder;
    ErrorBench bench = synthetic("b");
    bench.curves[1].right = false;
    bench.curves[1].verdict = "tile 3, 4 is too bright";
    write_error_report(folder.path(), bench,
                       {"t", "c", "", {{"default", std::nullopt, true, "It is wrong."}}});
    const std::string html = text_of(folder.path() / "report.html");
    EXPECT_NE(html.find("Void: the picture is wrong. tile 3, 4 is too bright"), std::string::npos);
    EXPECT_NE(html.find("void</b> <span>It is wrong."), std::string::npos);
}

TEST(ErrorReport, BrowserDecodesEveryImageAndLogsNothing) {
    const std::string browser = first_of_path({"chromium-headless-shell", "chromium", "chromium-browser"});
    if (browser.empty()) GTEST_SKIP() << "Chromium is not installed (Debian: chromium-headless-shell)";
    const TemporaryFolder folder;
    const auto written =
        write_error_report(folder.path(), synthetic(hostile), {"Report", "triad bench", "today", {}});
    const std::size_t images = count(text_of(written.back()), "<img");
    for (const std::string window : {"1280,900", "360,800"}) {
        const Page page = open_page(browser, written.back(), folder.path(), window);
        const std::string all = std::to_string(images);
        EXPECT_NE(page.dom.find("data-decoded=\"" + all + " of " + all + "\""), std::string::npos)
            << page.log.substr(0, 2000);
        EXPECT_NE(page.dom.find("data-overflow=\"0\""), std::string::npos)
            << "the page is wider than a window of " << window;
        EXPECT_EQ(page.log.find(":CONSOLE"), std::string::npos) << page.log.substr(0, 2000);
    }
}

}  // namespace
}  // namespace triad
