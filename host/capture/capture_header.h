#pragma once
/// The header of a capture's file: everything but the bytes, as JSON.
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "capture/capture.h"

namespace triad {

/// Contents by their places in the file. Those with the same bytes have one place.
class ContentTable {
  public:
    std::size_t place_of(const Recording::Content& content);
    const std::vector<Recording::Content>& contents() const { return contents_; }

  private:
    std::map<std::string, std::size_t> by_hash_;
    std::map<const void*, std::size_t> known_;
    std::vector<Recording::Content> contents_;
};

std::string capture_header(const Capture& capture, ContentTable& contents);

/// The capture, whose contents are asked for by their places. refuse: throws what is wrong.
Capture capture_of_header(const std::string& header,
                          const std::function<Recording::Content(std::size_t)>& content_at,
                          const std::function<void(const std::string&)>& refuse);

/// Throws by `refuse` where something is not consistent.
void check_capture(const Capture& capture, const std::function<void(const std::string&)>& refuse);

}  // namespace triad
