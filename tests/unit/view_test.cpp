// triad view without a device or a server: what it lets a page ask for, which requests it answers, what a
// magnifier shows.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "panel/panel.h"
#include "sentence_of.h"
#include "small_frame.h"
#include "viewer/magnifier.h"
#include "viewer/request_check.h"
#include "viewer/view_change.h"
#include "viewer/view_state.h"

namespace triad {
namespace {

TEST(ViewChange, ReadsWhatAPageSends) {
    const ViewChange c = parse_change(
        R"({"orbit":[0.5,-0.25],"pan":[0,1],"zoom":2,"camera":-1,"region":[1,2,3,4],"exposure":-1.5,
            "tonemap":"agx","variant":"","panel":"qd-oled","subpixels":false,"paused":true,"scale":0.5})");
    EXPECT_EQ(*c.orbit, dvec2(0.5, -0.25));
    EXPECT_EQ(*c.camera, -1);
    EXPECT_EQ((*c.region)[3], 4u);
    EXPECT_EQ(*c.exposure, -1.5);
    EXPECT_EQ(*c.tone_map, "agx");
    EXPECT_TRUE(c.variant && c.variant->empty());
    EXPECT_FALSE(*c.subpixels);
    EXPECT_FALSE(parse_change("{}").zoom);
}

TEST(ViewChange, RefusesWhatIsNone) {
    const std::string deep = "{\"orbit\":" + std::string(5000, '[') + std::string(5000, ']') + "}";
    for (const std::string text : {"",
                                   "nonsense",
                                   "{",
                                   "[]",
                                   "null",
                                   "3",
                                   "{\"orbit\":[1]}",
                                   "{\"orbit\":[1,2,3]}",
                                   "{\"orbit\":[\"a\",1]}",
                                   "{\"orbit\":[NaN,0]}",
                                   "{\"zoom\":NaN}",
                                   "{\"zoom\":Infinity}",
                                   "{\"zoom\":1e999}",
                                   "{\"zoom\":0}",
                                   "{\"zoom\":-1}",
                                   "{\"exposure\":1e9}",
                                   "{\"exposure\":\"1\"}",
                                   "{\"exposure\":null}",
                                   "{\"camera\":0.5}",
                                   "{\"camera\":-2}",
                                   "{\"region\":[0,0,-1,4]}",
                                   "{\"region\":[0,0,1]}",
                                   "{\"region\":[0,0,1e9,1]}",
                                   "{\"scale\":2}",
                                   "{\"paused\":1}",
                                   "{\"tonemap\":3}",
                                   "{\"film\":\"/etc/passwd\"}",
                                   "{\"\\u0000\":1}",
                                   "{\"variant\":\"\xff\"}",
                                   deep.c_str()})
        sentence_of(Exit::usage, [&] { parse_change(text); });
    EXPECT_NE(sentence_of(Exit::usage, [] { parse_change("{\"zom\":1}"); }).find("zoom"), std::string::npos);
    sentence_of(Exit::usage, [] { parse_change("{\"variant\":\"" + std::string(5000, 'a') + "\"}"); });
}

TEST(ViewChange, SaysHowSoonItStopsARender) {
    EXPECT_EQ(urgency_of(parse_change(R"({"orbit":[0,1],"exposure":1})")), Urgency::picture);
    EXPECT_EQ(urgency_of(parse_change(R"({"region":[0,0,0,0]})")), Urgency::pause);
    EXPECT_EQ(urgency_of(parse_change(R"({"exposure":1})")), Urgency::display);
    EXPECT_EQ(urgency_of(parse_change("{}")), Urgency::none);
}

const ViewPlace place{8000, "abc"};

RequestHead getting(const std::string& path) {
    return {.method = "GET", .path = path, .host = "127.0.0.1:8000"};
}
RequestHead posting() {
    return {.method = "POST",
            .path = "/abc/change",
            .host = "localhost:8000",
            .origin = "http://localhost:8000",
            .fetch_site = "same-origin",
            .content_type = "application/json",
            .content_length = "2"};
}
int status_of(const RequestHead& request) {
    const auto refusal = refusal_of(request, place);
    return refusal ? refusal->status : 200;
}

TEST(RequestCheck, AnswersItsOwnPage) {
    EXPECT_EQ(status_of(getting("/abc/")), 200);
    EXPECT_EQ(status_of(posting()), 200);
    RequestHead link = getting("/abc/");
    link.fetch_site = "cross-site";  // a link from a page of a terminal
    EXPECT_EQ(status_of(link), 200);
    RequestHead command = posting();  // no browser
    command.origin = command.fetch_site = "", command.host = "LOCALHOST:8000";
    EXPECT_EQ(status_of(command), 200);
    command.content_type = "Application/JSON; charset=utf-8";
    EXPECT_EQ(status_of(command), 200);
}

TEST(RequestCheck, RefusesOtherNamesOfThisMachine) {
    for (const char* host :
         {"", "evil.example", "evil.example:8000", "127.0.0.1", "127.0.0.1:8001", "localhost",
          "localhost:80000", "localhost.evil.example:8000", "[::1]:8000", "0.0.0.0:8000"}) {
        RequestHead request = getting("/abc/");
        request.host = host;
        EXPECT_EQ(status_of(request), 403) << host;
    }
}

TEST(RequestCheck, RefusesOtherPages) {
    for (const char* origin :
         {"http://evil.example", "null", "https://127.0.0.1:8000", "http://127.0.0.1:8001",
          "http://localhost:8000.evil.example", "http://localhost:8000@evil.example"}) {
        RequestHead request = posting();
        request.origin = origin;
        EXPECT_EQ(status_of(request), 403) << origin;
    }
    for (const char* site : {"cross-site", "same-site", "whatever"}) {
        RequestHead request = posting();
        request.fetch_site = site;
        EXPECT_EQ(status_of(request), 403) << site;
        RequestHead frame = getting("/abc/frame");
        frame.fetch_site = site;
        EXPECT_EQ(status_of(frame), 403) << site;
    }
}

TEST(RequestCheck, RefusesPathsMethodsAndBodies) {
    for (const char* path : {"/", "", "/abc", "/abd/", "/ABC/", "//abc/", "/frame"})
        EXPECT_EQ(status_of(getting(path)), 404) << path;
    const auto with = [](auto change) {
        RequestHead request = posting();
        change(request);
        return status_of(request);
    };
    EXPECT_EQ(with([](RequestHead& r) { r.method = "PUT"; }), 405);
    EXPECT_EQ(with([](RequestHead& r) { r.method = "OPTIONS"; }), 405);
    EXPECT_EQ(with([](RequestHead& r) { r.content_type = "text/plain"; }), 415);
    EXPECT_EQ(with([](RequestHead& r) { r.content_type = ""; }), 415);
    EXPECT_EQ(with([](RequestHead& r) { r.transfer_encoding = "chunked"; }), 411);
    for (const char* length : {"", "16385", "-1", "0x10", "99999999999999999999"})
        EXPECT_EQ(with([&](RequestHead& r) { r.content_length = length; }), 413) << length;
    RequestHead body = getting("/abc/");
    body.content_length = "5";
    EXPECT_EQ(status_of(body), 400);
    EXPECT_NE(random_token(), random_token());
    EXPECT_EQ(random_token().size(), 32u);
}

TEST(Magnifier, ShowsTheEmittersOfAPanel) {
    ViewFrame frame = small_frame();
    frame.panel = std::make_shared<const Panel>(*builtin_panel("rgb"));
    const ViewFrame lens = magnified(frame, 0, 0, 2, 9);
    ASSERT_EQ(lens.columns, 18u);
    const auto colour = [&](unsigned x, unsigned y) {
        const std::uint8_t* p = &lens.rgba[4 * (y * lens.columns + x)];
        return std::array<int, 3>{p[0], p[1], p[2]};
    };
    // White lights red, green and blue beside each other.
    EXPECT_GT(colour(1, 4)[0], colour(1, 4)[2]);
    EXPECT_GT(colour(4, 4)[1], colour(4, 4)[0]);
    EXPECT_GT(colour(7, 4)[2], colour(7, 4)[0]);
    EXPECT_EQ(colour(1, 4), colour(10, 4));
}

/// A region covers a part: what a magnifier shows of it lies within.
TEST(Magnifier, StaysWithinWhatIsThere) {
    ViewFrame frame = small_frame();
    frame.x = 10, frame.y = 20, frame.full_width = frame.full_height = 100;
    for (const unsigned x : {10u, 13u})
        for (const unsigned y : {20u, 21u}) {
            const ViewFrame lens = magnified(frame, x, y, 11, 2);
            EXPECT_GE(lens.x, 10u);
            EXPECT_LE(lens.x + lens.width, 14u);
            EXPECT_LE(lens.y + lens.height, 22u);
            EXPECT_EQ(lens.rgba.size(), std::size_t(lens.width) * lens.height * 16);
        }
}

TEST(ViewState, KeepsTheCourseShort) {
    ViewCourse course;
    for (int i = 1; i < 5000; ++i) {
        Progress progress;
        progress.seconds = i, progress.samples = i, progress.relmse = 1.0 / i;
        course.add(progress);
    }
    EXPECT_LE(course.points.size(), 256u);
    EXPECT_EQ(course.points.back().seconds, 4999);
    ViewFacts facts;
    facts.scene = "bad \xff name";
    EXPECT_NE(json_of(facts).find("bad"), std::string::npos);
}

}  // namespace
}  // namespace triad
