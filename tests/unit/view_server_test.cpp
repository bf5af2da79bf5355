// triad view over HTTP: whom it answers, and what.
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "sentence_of.h"
#include "small_frame.h"
#include "viewer/exchange.h"
#include "viewer/view_change.h"
#include "viewer/view_server.h"
#include "viewer/view_state.h"

namespace triad {
namespace {

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

}  // namespace
}  // namespace triad
