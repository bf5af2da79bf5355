// The texts of the progress display.
#include "base/progress.h"

#include <gtest/gtest.h>

using namespace triad;

TEST(Progress, time_left_follows_the_pace) {
    EXPECT_DOUBLE_EQ(seconds_left({0.25, 10, 4, -1}), 30);
    EXPECT_LT(seconds_left({0, 10, 0, -1}), 0);
}

TEST(Progress, clock_rounds_up_and_carries) {
    EXPECT_EQ(clock_time(0), "0:00");
    EXPECT_EQ(clock_time(59.2), "1:00");
    EXPECT_EQ(clock_time(3599.5), "1:00:00");
    EXPECT_EQ(clock_time(7325), "2:02:05");
}

TEST(Progress, bar_never_reaches_the_last_column) {
    for (unsigned columns = 1; columns < 200; ++columns)
        EXPECT_LT(bar_text({0.5, 3600, 123456, 0.0123}, columns).size(), std::max(columns, 2u)) << columns;
}

TEST(Progress, not_done_is_never_shown_as_100_percent) {
    EXPECT_NE(line_text({0.9999, 100, 64, 0.01}).find("99 %"), std::string::npos);
    EXPECT_NE(bar_text({0.9999, 100, 64, 0.01}, 100).find(" 99 %"), std::string::npos);
}

TEST(Progress, json_says_null_for_what_is_not_known) {
    EXPECT_EQ(json_text({0, 0, 0, -1}),
              R"({"progress": 0, "seconds": 0.000, "seconds_left": null, "spp": 0, "relmse": null})");
    EXPECT_EQ(json_text({0.5, 2, 8, 0.25}),
              R"({"progress": 0.5, "seconds": 2.000, "seconds_left": 2.000, "spp": 8, "relmse": 0.25})");
}
