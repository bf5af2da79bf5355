#include "viewer/view.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

#include "base/child.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel_for.h"
#include "device/device.h"
#include "viewer/view_loop.h"
#include "viewer/view_server.h"

namespace triad {
namespace {

/// Without a goal a picture is looked at for as long as one likes.
constexpr std::uint64_t endless = 65536;

RenderRequest checked(RenderRequest request) {
    if (request.pixel) throw Error(Exit::usage, "A view is of a picture: leave --pixel out.");
    if (request.samples || request.share)
        throw Error(Exit::usage, "A view shows a picture from its first sample on: leave --samples out.");
    request.profile = true;  // kernel times; and no file is written
    if (!request.spp && !request.error && !request.time) request.spp = endless;
    if (request.style.denoise != Denoiser::off)
        throw Error(Exit::usage,
                    "--denoise is for triad render and resolve: the page shows what the samples say.");
    complete(request);
    set_host_threads(request.threads);
    kernel_source::set_folder(request.kernels_path);
    return request;
}

/// In a thread of its own that nobody waits for: some browsers stay until they are closed.
void open_browser(const std::string& url) {
    const bool has_desktop = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
    if (!has_desktop) return;
    std::thread([url] { run_child({.arguments = {"xdg-open", url}, .own_group = true}); }).detach();
}

}  // namespace

Exit view(ViewRequest request) {
    RenderRequest render = checked(std::move(request.render));
    const InterruptGuard guard("\ntriad: the view ends\n");
    Exchange exchange;
    ViewServer server(exchange, request.port);
    std::printf("%s\n", server.place().url().c_str());
    std::fflush(stdout);
    inform("The view is at the address above, for this machine alone. Ctrl-C ends it.");
    if (request.open_browser) open_browser(server.place().url());
    std::exception_ptr failed;
    std::jthread renders([&] {
        try {
            ViewLoop(std::move(render), std::move(request.command), exchange).run();
        } catch (...) {
            failed = std::current_exception();
        }
        exchange.close();
    });
    while (!exchange.closed() && !guard.interrupted())
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    exchange.close();
    renders.join();
    if (failed) std::rethrow_exception(failed);
    return Exit::done;
}

}  // namespace triad
