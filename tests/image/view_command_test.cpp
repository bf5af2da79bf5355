// triad view as a person uses it: the program, and its page in a browser.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "base/temporary_folder.h"
#include "program.h"
#include "running.h"

namespace triad {
namespace {

/// A port of this machine that another program listens at.
class TakenPort {
  public:
    TakenPort() {
        sockaddr_in address{};
        address.sin_family = AF_INET, address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(::listen(socket_, 1), 0);
        EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
        number_ = ::ntohs(address.sin_port);
    }
    ~TakenPort() { ::close(socket_); }
    std::string number() const { return std::to_string(number_); }

  private:
    int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
    unsigned number_ = 0;
};

TEST(ViewCommand, RefusesWhatItCannotShow) {
    const TakenPort taken;
    const Outcome busy = run_triad("view --no-browser --port " + taken.number());
    EXPECT_EQ(busy.exit, 1) << busy.output;
    EXPECT_NE(busy.output.find("--port " + taken.number() + ":"), std::string::npos) << busy.output;
    EXPECT_EQ(run_triad("view --no-browser nothing.glb").exit, 2);
    EXPECT_EQ(run_triad("view --no-browser --pixel 1,1").exit, 1);
    EXPECT_EQ(run_triad("view --no-browser --samples 0:4").exit, 1);
    EXPECT_EQ(run_triad("view --no-browser --port 65536").exit, 1);
    EXPECT_EQ(run_triad("view --no-browser --exposure nan").exit, 1);
}

TEST(ViewCommand, EndsWellWhenAskedTo) {
    for (const int signal : {SIGINT, SIGTERM}) {
        Running view("view --no-browser --size 64x64");
        ASSERT_TRUE(view.says("The view is at the address above")) << view.said();
        view.send(signal);
        EXPECT_EQ(view.wait(), 0) << view.said();
    }
}

TEST(ViewCommand, ItsPageDoesWhatHandsAndKeysAsk) {
    if (std::system("command -v chromium-headless-shell chromium >/dev/null") != 0 &&
        std::system("command -v chromium >/dev/null") != 0)
        GTEST_SKIP() << "Chromium is not installed (Debian: chromium-headless-shell)";
    if (std::string(TRIAD_PYTHON).empty()) GTEST_SKIP() << "There is no Python with numpy";
    const TemporaryFolder folder;
    const Outcome page = run_program(TRIAD_PYTHON,
                                     "'" TRIAD_SOURCE_DIR "/tests/image/view_page.py' '" TRIAD_PROGRAM "' '" +
                                         folder.path().string() + "'",
                                     "PYTHONDONTWRITEBYTECODE=1");
    EXPECT_EQ(page.exit, 0) << page.output;
}

}  // namespace
}  // namespace triad
