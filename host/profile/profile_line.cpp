#include "profile/profile_line.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "base/text.h"
#include "page/html.h"

namespace triad {
namespace {

/// Of the time line: what is shorter than a pixel is drawn with its neighbours.
constexpr double line_width = 1000, row_height = 22;
/// Of the last run, from its middle on: the whole would be a stripe.
constexpr double line_seconds = 0.25;

/// Rectangles of one row, those that would touch at this scale as one.
class LineRow {
  public:
    LineRow(double y, double from, double to) : y_(y), from_(from), scale_(line_width / (to - from)) {}

    void add(double start, double end, std::size_t colour, const std::string& name) {
        const double x = std::max(0.0, (start - from_) * scale_),
                     right = std::min(line_width, (end - from_) * scale_);
        if (right <= 0 || x >= line_width || right <= x) return;
        if (name == name_ && x - right_ < 0.3) {
            right_ = right;
            return;
        }
        flush();
        x_ = x, right_ = right, colour_ = colour, name_ = name;
    }
    std::string svg() {
        flush();
        return svg_;
    }

  private:
    double y_, from_, scale_, x_ = 0, right_ = -1;
    std::size_t colour_ = 0;
    std::string name_, svg_;

    void flush() {
        if (right_ < 0) return;
        svg_ += format("<rect class=\"k%u\" x=\"%.2f\" y=\"%.0f\" width=\"%.2f\" height=\"%.0f\"><title>",
                       unsigned(colour_), x_, y_, std::max(0.2, right_ - x_), row_height - 4) +
                html_escape(name_) + "</title></rect>\n";
        right_ = -1;
    }
};

}  // namespace

std::string profile_line(const Profile& p, const std::vector<HostSpan>& spans) {
    if (p.commands.empty()) return "";
    const auto host = [&](std::int64_t device) { return 1e-9 * double(device + p.clock_offset); };
    const double first = host(p.commands.front().start), last = host(p.commands.back().end);
    const double from = std::max(first, 0.5 * (first + last - line_seconds)),
                 to = std::min(last, from + line_seconds);
    std::map<std::string, std::size_t> colours;
    for (const KernelRow& r : p.rows) colours.emplace(r.kernel, std::min<std::size_t>(colours.size(), 6));
    std::string rows, names;
    unsigned row = 0;
    const auto label = [&](const std::string& name) {
        names +=
            format("<text x=\"0\" y=\"%.0f\">", row * 2 * row_height + 14) + html_escape(name) + "</text>\n";
        return row++ * 2 * row_height + row_height - 2;
    };
    unsigned threads = 0;
    for (const HostSpan& s : spans) threads = std::max(threads, s.thread + 1);
    for (unsigned thread = 0; thread < threads; ++thread) {
        std::vector<const HostSpan*> of_thread;  // the innermost: what encloses others is the whole run
        for (const HostSpan& s : spans)
            if (s.thread == thread && s.name != "render" && 1e-9 * double(s.end) > from &&
                1e-9 * double(s.start) < to)
                of_thread.push_back(&s);
        if (of_thread.empty()) continue;
        std::ranges::sort(of_thread, {}, &HostSpan::start);
        LineRow line(label(thread == 0 ? "host" : "host, thread " + std::to_string(thread)), from, to);
        for (const HostSpan* s : of_thread)
            line.add(1e-9 * double(s->start), 1e-9 * double(s->end), s->name == "launch" ? 5 : 6, s->name);
        rows += line.svg();
    }
    LineRow queue(label("queue of the device"), from, to);
    for (const DeviceCommand& c : p.commands) queue.add(host(c.start), host(c.end), colours[c.name], c.name);
    rows += queue.svg();
    std::string legend;
    for (const KernelRow& r : p.rows) {
        legend += (legend.empty() ? "" : " &middot; ") +
                  std::string("<svg width=\"12\" height=\"12\"><rect class=\"k") +
                  std::to_string(colours[r.kernel]) + "\" width=\"12\" height=\"12\"/></svg> " +
                  html_escape(r.kernel);
    }
    return format("<h3>%.0f ms of the last run</h3>\n", 1e3 * (to - from)) +
           format(
               "<div class=\"line\"><svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"Time line\">\n",
               line_width, row * 2 * row_height) +
           names + rows + "</svg></div>\n<p class=\"soft\">" + legend + "</p>\n";
}

}  // namespace triad
