// The texts of the progress display.
#include <algorithm>

#include "base/progress.h"

#include <gtest/gtest.h>

using namespace triad;

TEST(Progress, clock_rounds_up_and_carries) {
    EXPECT_EQ(clock_time(0), "0:00");
    EXPECT_EQ(clock_time(59.2), "1:00");
    EXPECT_EQ(clock_time(3599.5), "1:00:00");
    EXPECT_EQ(clock_time(7325), "2:02:05");
}

TEST(Progress, bar_never_reaches_the_last_column) {
    for (unsigned columns = 1; columns < 200; ++columns)
        EXPECT_LT(bar_text({0.5, 3600, 3600, 123456, 0.0123, -1.02, 0.001, 7200}, columns).size(),
                  std::max(columns, 2u))
            << columns;
}

TEST(Progress, not_done_is_never_shown_as_100_percent) {
    EXPECT_NE(line_text({.done = 0.9999, .seconds = 100}).find("99 %"), std::string::npos);
    EXPECT_NE(bar_text({.done = 0.9999, .seconds = 100}, 100).find(" 99 %"), std::string::npos);
}

TEST(Progress, says_the_error_its_trend_and_when_it_will_be_as_asked_for) {
    const ProgressState state{0.25, 10, 30, 62.5, 0.0041, -1.02, 0.001, 90};
    EXPECT_EQ(line_text(state),
              "25 % after 0:10, 0:30 left, 62.5 spp, relMSE 0.0041 ~ spp^-1.02, 0.001 in 1:30");
    EXPECT_NE(bar_text(state, 120).find("relMSE 0.0041 ~ spp^-1.02, 0.001 in 1:30"), std::string::npos);
    EXPECT_EQ(line_text({.done = 0.25,
                         .seconds = 10,
                         .seconds_left = 30,
                         .spp = 4,
                         .relmse = 0.1,
                         .perceived_noise = 1.23}),
              "25 % after 0:10, 0:30 left, 4 spp, relMSE 0.1, perceived noise 1.2");
    EXPECT_EQ(line_text({.done = 0.25, .seconds = 10, .spp = 4}), "25 % after 0:10, ? left, 4 spp, relMSE ?");
}

TEST(Progress, json_says_null_for_what_is_not_known) {
    EXPECT_EQ(json_text({}),
              R"({"progress": 0, "seconds": 0.000, "seconds_left": null, "spp": 0, "relmse": null, )"
              R"("trend": null, "seconds_to_error": null, "perceived_noise": null})");
    EXPECT_EQ(json_text({0.5, 2, 2, 8, 0.25, -0.5, 0.125, 14, 1.5}),
              R"({"progress": 0.5, "seconds": 2.000, "seconds_left": 2.000, "spp": 8, "relmse": 0.25, )"
              R"("trend": -0.5, "seconds_to_error": 14.000, "perceived_noise": 1.5})");
}

TEST(Progress, a_job_that_is_no_render_says_what_it_does) {
    const ProgressState state{.done = 0.25, .seconds = 10, .seconds_left = 30, .doing = "peaks"};
    EXPECT_EQ(line_text(state), "25 % after 0:10, 0:30 left, peaks");
    EXPECT_NE(bar_text(state, 100).find("0:30 left  peaks"), std::string::npos);
    EXPECT_EQ(json_text(state),
              "{\"progress\": 0.25, \"seconds\": 10.000, \"seconds_left\": 30.000, \"doing\": \"peaks\"}");
}

TEST(Progress, phases_have_words) {
    EXPECT_STREQ(phase_words("load"), "loading the scene");
    EXPECT_STREQ(phase_words("build"), "building trees");
    EXPECT_STREQ(phase_words("something else"), "something else");
    EXPECT_EQ(phase_json("load", 0.25), "{\"phase\": \"load\", \"seconds\": 0.250}");
}
