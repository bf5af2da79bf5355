#pragma once
/// The page of a view over HTTP, for this machine alone.
#include <memory>
#include <string>

#include "viewer/exchange.h"
#include "viewer/request_check.h"

namespace triad {

/// Answers below place().url():
///   GET /             the page, and its files
///   GET events        server-sent events: the state (view_state.h) whenever it changes
///   GET frame         the whole picture as RGBA bytes; X-Triad-Frame says number, size and window
///   GET region        the same of the region; 204 where there is none
///   GET magnifier?x=&y=&across=&zoom=   the emitters around a pixel, as RGBA bytes
///   GET save/NAME.EXT a file of the picture
///   POST change       a ViewChange; 400 with a sentence where it is none
class ViewServer {
  public:
    /// Binds to 127.0.0.1. `port` 0: any that is free. Throws Error(usage) where it cannot. The exchange must
    /// live as long.
    ViewServer(Exchange& exchange, unsigned port);
    /// Closes the exchange, and waits for requests that are being answered.
    ~ViewServer();
    ViewServer(const ViewServer&) = delete;
    ViewServer& operator=(const ViewServer&) = delete;

    const ViewPlace& place() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace triad
