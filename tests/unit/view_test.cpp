// triad view without a device: its camera, what it lets a page ask for, and whom it answers.
#include <gtest/gtest.h>
#include <httplib.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "panel/panel.h"
#include "sentence_of.h"
#include "viewer/exchange.h"
#include "viewer/magnifier.h"
#include "viewer/orbit_camera.h"
#include "viewer/request_check.h"
#include "viewer/view_change.h"
#include "viewer/view_server.h"
#include "viewer/view_state.h"

namespace triad {
namespace {

Bounds unit_box() {
    Bounds bounds;
    bounds.add(dvec3(-1)), bounds.add(dvec3(1));
    return bounds;
}

/// From +z at the origin.
OrbitCamera from_the_front() {
    return orbit_camera(look_at({0, 0, 4}, {0, 0, 0}, 40 * pi / 180, 1.5), 1.5, 4, unit_box());
}

/// Where a point is seen, in heights of the picture from its middle.
dvec2 seen(const View& view, const dvec3& point) {
    const dvec3 way = point - view.eye;
    const double depth = view.orthographic ? 1 : glm::dot(way, view.forward);
    return dvec2(glm::dot(way, view.right), glm::dot(way, view.up)) / (depth * 2 * view.extent.y);
}

void expect_near(const dvec3& a, const dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-9); }

TEST(OrbitCamera, GoesRoundItsTarget) {
    const OrbitCamera side = orbited(from_the_front(), pi / 2, 0);
    expect_near(side.view.eye, {4, 0, 0});
    expect_near(side.view.forward, {-1, 0, 0});
    expect_near(side.view.up, {0, 1, 0});
    const OrbitCamera above = orbited(from_the_front(), 0, pi / 6);
    expect_near(above.view.eye, {0, 2, 2 * std::sqrt(3.0)});
    OrbitCamera round = from_the_front();
    for (int i = 0; i < 36; ++i) round = orbited(round, pi / 18, 0);
    expect_near(round.view.eye, {0, 0, 4});
}

TEST(OrbitCamera, StopsBeforeThePoles) {
    for (const double way : {10.0, -10.0}) {
        const OrbitCamera pole = orbited(from_the_front(), 0, way);
        EXPECT_NEAR(pole.view.forward.y, way > 0 ? -std::sin(89.5 * pi / 180) : std::sin(89.5 * pi / 180),
                    1e-9);
        EXPECT_NEAR(pole.view.right.y, 0, 1e-12);
        const OrbitCamera back = orbited(pole, 0, way > 0 ? -89.5 * pi / 180 : 89.5 * pi / 180);
        expect_near(back.view.eye, {0, 0, 4});
    }
}

/// One that looks straight down from the start may come back, and goes no further.
TEST(OrbitCamera, LeavesAPole) {
    const OrbitCamera down = orbit_camera(look_at({0, 4, 0}, {0, 0, 0}, 0.7, 1), 1, 4, unit_box());
    EXPECT_NEAR(orbited(down, 0, 0.5).view.eye.y, 4, 1e-9);
    const OrbitCamera lower = orbited(down, 0, -pi / 4);
    EXPECT_NEAR(lower.view.eye.y, 4 * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::length(lower.view.eye), 4, 1e-9);
}

TEST(OrbitCamera, PansWhatIsSeen) {
    const OrbitCamera begun = orbited(from_the_front(), 0.3, 0.2);
    const dvec2 shift(0.25, -0.1);
    const dvec2 before = seen(begun.view, begun.target),
                after = seen(panned(begun, shift).view, begun.target);
    EXPECT_LT(glm::length(after - before - shift), 1e-9);
}

TEST(OrbitCamera, ZoomKeepsTheTargetAndItsLimits) {
    const OrbitCamera near = zoomed(from_the_front(), 0.5);
    expect_near(near.view.eye, {0, 0, 2});
    EXPECT_NEAR(near.view.focus_distance, 2, 1e-12);
    OrbitCamera camera = from_the_front();
    for (int i = 0; i < 50; ++i) camera = zoomed(camera, 1e-3);
    EXPECT_GT(glm::length(camera.view.eye), 0);
    for (int i = 0; i < 50; ++i) camera = zoomed(camera, 1e3);
    EXPECT_NEAR(glm::length(camera.view.eye), 1e4 * camera.size, 1e-3);
}

TEST(OrbitCamera, KeepsLensAndFocusInProportion) {
    OrbitCamera camera = from_the_front();
    camera.view.lens_radius = 0.1, camera.view.focus_distance = 3;
    const OrbitCamera far = zoomed(camera, 2);
    EXPECT_EQ(far.view.lens_radius, 0.1);
    EXPECT_NEAR(far.view.focus_distance, 6, 1e-12);
}

TEST(OrbitCamera, OrthographicViewsKeepTheirDistance) {
    View view = look_at({0, 0, 4}, {0, 0, 0}, 0.7, 1);
    view.orthographic = true, view.extent = {2, 1};
    const OrbitCamera camera = orbit_camera(view, 2, 4, unit_box());
    const OrbitCamera side = orbited(camera, pi / 2, 0);
    expect_near(side.view.eye, {4, 0, 0});
    expect_near(side.view.forward, {-1, 0, 0});
    expect_near(glm::cross(side.view.right, side.view.up), -side.view.forward);
    const OrbitCamera large = zoomed(side, 0.5);
    expect_near(large.view.eye, side.view.eye);
    EXPECT_NEAR(large.view.extent.x, 1, 1e-12);
    EXPECT_LT(glm::length(seen(panned(side, {0.5, 0}).view, side.target) - dvec2(0.5, 0)), 1e-9);
}

/// What the page offers to copy renders the same picture bit for bit.
TEST(OrbitCamera, IsThatOfLookAt) {
    OrbitCamera camera = from_the_front();
    for (int i = 0; i < 5; ++i) camera = zoomed(panned(orbited(camera, 0.37, 0.11), {0.03, -0.07}), 0.9);
    const View again = look_at(camera.view.eye, camera.target, camera.fov * pi / 180, camera.aspect);
    EXPECT_EQ(again.forward, camera.view.forward);
    EXPECT_EQ(again.right, camera.view.right);
    EXPECT_EQ(again.extent, camera.view.extent);
    EXPECT_EQ(again.focus_distance, camera.view.focus_distance);
}

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

TEST(Exchange, HandsOutChangesByUrgency) {
    Exchange exchange;
    EXPECT_EQ(exchange.urgency(), Urgency::none);
    exchange.post(parse_change(R"({"exposure":1})"));
    exchange.post(parse_change(R"({"orbit":[1,0]})"));
    EXPECT_EQ(exchange.urgency(), Urgency::picture);
    EXPECT_TRUE(exchange.take_changes(Urgency::display).empty());
    EXPECT_EQ(exchange.take_changes().size(), 2u);
    EXPECT_EQ(exchange.urgency(), Urgency::none);
    EXPECT_TRUE(exchange.seconds_since_move());
    EXPECT_FALSE(exchange.seconds_since_move());
    ViewChange some;
    some.exposure = 1;
    for (int i = 0; i < 256; ++i) EXPECT_TRUE(exchange.post(some));
    EXPECT_FALSE(exchange.post(some));
    EXPECT_TRUE(exchange.post({})) << "nothing does not wait";
}

TEST(Exchange, WakesWhoWaitsWhenItCloses) {
    Exchange exchange;
    std::thread follower([&] { EXPECT_FALSE(exchange.state_after(0, 1000)); });
    std::thread saver([&] { EXPECT_FALSE(exchange.file(".png", 1000)); });
    while (!exchange.has_files()) std::this_thread::yield();
    exchange.close();
    follower.join(), saver.join();
    EXPECT_FALSE(exchange.post({}));
    EXPECT_EQ(exchange.urgency(), Urgency::picture);
}

/// A server and a client that says what it likes.
struct Served {
    Exchange exchange;
    ViewServer server{exchange, 0};
    httplib::Client client{"127.0.0.1", int(server.place().port)};
    std::string root = "/" + server.place().token + "/";

    int post(const std::string& body, const httplib::Headers& headers = {}) {
        const auto reply = client.Post(root + "change", headers, body, "application/json");
        return reply ? reply->status : -1;
    }
    httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) {
        return client.Get(root + path, headers);
    }
};

ViewFrame small_frame() {
    ViewFrame frame;
    frame.full_width = frame.width = frame.columns = 4, frame.full_height = frame.height = frame.rows = 2;
    frame.rgba.assign(32, 255);
    return frame;
}

TEST(ViewServer, ServesThePageAndItsFiles) {
    Served s;
    const auto page = s.get("");
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200);
    EXPECT_NE(page->body.find("<canvas id=\"picture\""), std::string::npos);
    const std::string policy = page->get_header_value("Content-Security-Policy");
    EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
    for (const char* file :
         {"view.js", "view.css", "style.css", "picture.js", "link.js", "chart.js", "keys.js"})
        EXPECT_EQ(s.get(file)->status, 200) << file;
    for (const char* file : {"nothing", "../host", "%2e%2e/x", "view.js/", "save/", "save/a.sh", "save/a"})
        EXPECT_EQ(s.get(file)->status, 404) << file;
    EXPECT_EQ(s.client.Get("/")->status, 404);
    EXPECT_EQ(s.client.Delete(s.root)->status, 405);
}

TEST(ViewServer, RefusesHostsOriginsAndBodies) {
    Served s;
    EXPECT_EQ(s.post("{\"zoom\":2}"), 204);
    EXPECT_EQ(s.get("", {{"Host", "evil.example"}})->status, 403);
    EXPECT_EQ(s.post("{}", {{"Origin", "http://evil.example"}}), 403);
    EXPECT_EQ(s.post("{}", {{"Sec-Fetch-Site", "cross-site"}}), 403);
    EXPECT_EQ(s.post("{\"zoom\":NaN}"), 400);
    EXPECT_EQ(s.post("nonsense"), 400);
    EXPECT_EQ(s.post(std::string(20000, ' ')), 413);
    EXPECT_EQ(s.client.Post(s.root + "change", "{}", "text/plain")->status, 415);
    EXPECT_EQ(s.client.Post(s.root + "nothing", "{}", "application/json")->status, 404);
    EXPECT_EQ(s.exchange.take_changes().size(), 1u);
}

TEST(ViewServer, HandsOutFramesAndMagnifiesThem) {
    Served s;
    EXPECT_EQ(s.get("frame")->status, 204);
    EXPECT_EQ(s.get("magnifier?x=1&y=1")->status, 204);
    s.exchange.show(small_frame(), false);
    const auto frame = s.get("frame");
    EXPECT_EQ(frame->body.size(), 32u);
    EXPECT_EQ(frame->get_header_value("X-Triad-Frame"), "1 4 2 0 0 4 2 4 2 0");
    EXPECT_EQ(s.get("region")->status, 204);
    EXPECT_EQ(s.get("magnifier?x=1&y=1&across=3&zoom=2")->body.size(), 3u * 2 * 2 * 2 * 4);
    EXPECT_EQ(s.get("magnifier?x=9&y=1")->status, 204);
    for (const char* query :
         {"", "?x=1", "?x=a&y=1", "?x=-1&y=1", "?x=1&y=1&zoom=1000", "?x=1&y=1&across=0", "?x=nan&y=1"})
        EXPECT_EQ(s.get(std::string("magnifier") + query)->status, 400) << query;
}

TEST(ViewServer, TellsStatesAsEventsToAFewPages) {
    Served s;
    s.exchange.tell(json_of({}));
    std::vector<std::thread> pages;
    std::atomic<int> following = 0, refused = 0;
    for (int i = 0; i < 8; ++i)
        pages.emplace_back([&] {
            httplib::Client client("127.0.0.1", int(s.server.place().port));
            const auto reply = client.Get(s.root + "events", [&](const char* data, std::size_t size) {
                if (std::string(data, size).starts_with("data: {")) ++following;
                return true;
            });
            if (reply && reply->status == 503) ++refused;
        });
    while (following < 6 || refused < 2) std::this_thread::yield();
    s.exchange.close();
    for (std::thread& page : pages) page.join();
    EXPECT_EQ(refused, 2);
}

TEST(ViewServer, SavesWhatTheOtherSideMakes) {
    Served s;
    std::thread renders([&] {
        while (!s.exchange.has_files()) s.exchange.wait(1);
        for (ViewFile& file : s.exchange.take_files()) {
            EXPECT_EQ(file.extension, ".triadfilm");
            file.bytes.set_value("film");
        }
    });
    const auto reply = s.get("save/a%20scene.triadfilm");
    renders.join();
    EXPECT_EQ(reply->body, "film");
    EXPECT_EQ(reply->get_header_value("Content-Disposition"), "attachment");
}

TEST(ViewServer, APortInUseIsASentence) {
    Served s;
    const std::string sentence =
        sentence_of(Exit::usage, [&] { ViewServer second(s.exchange, s.server.place().port); });
    EXPECT_NE(sentence.find("--port " + std::to_string(s.server.place().port)), std::string::npos);
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
