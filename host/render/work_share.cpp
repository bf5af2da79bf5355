#include "render/work_share.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace triad {
namespace {

/// Of what is left to all, a device takes this share of what it would do of it: the next pieces are smaller.
constexpr double of_the_rest = 0.4;
/// Items of a first piece, by which it is measured what they take.
constexpr std::size_t unknown_items = 16;

}  // namespace

WorkShare::WorkShare(std::vector<std::uint64_t> sizes, std::vector<double> paces)
    : sizes_(std::move(sizes)), paces_(std::move(paces)) {
    left_ = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t(0));
    double all = 0, passed = 0;
    for (std::size_t i = 0; i < paces_.size(); ++i) all += pace_of(i);
    std::size_t at = 0;
    std::uint64_t size = 0;
    for (std::size_t i = 0; i < paces_.size(); ++i) {
        passed += pace_of(i);
        Part part{at, at, 0};
        const bool is_last = i + 1 == paces_.size();
        while (at < sizes_.size() && (is_last || double(size) < passed / all * double(left_))) {
            size += sizes_[at], part.left += sizes_[at];
            part.end = ++at;
        }
        parts_.push_back(part);
    }
}

/// Where none is known, all are taken as equal.
double WorkShare::pace_of(std::size_t device) const {
    if (paces_[device] > 0) return paces_[device];
    double sum = 0, known = 0;
    for (const double pace : paces_) sum += pace, known += pace > 0;
    return known > 0 ? sum / known : 1;
}

WorkPiece WorkShare::take(std::size_t device, double fit, std::size_t most) {
    if (left_ == 0) return {};
    std::size_t from = device;
    if (parts_[device].begin == parts_[device].end)
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (double(parts_[i].left) * pace_of(from) > double(parts_[from].left) * pace_of(i)) from = i;
    Part& part = parts_[from];
    const bool is_unknown = fit <= 0;
    if (is_unknown)
        most = std::min(most, unknown_items);
    else if (parts_.size() > 1) {
        double all = 0;
        for (std::size_t i = 0; i < paces_.size(); ++i) all += pace_of(i);
        fit = std::min(fit, of_the_rest * double(left_) * pace_of(device) / all);
    }
    const bool own = from == device;
    WorkPiece piece{part.begin, 0};
    std::uint64_t size = 0;
    while (part.begin < part.end && piece.count < most &&
           (piece.count == 0 || is_unknown || double(size) < fit)) {
        const std::size_t item = own ? part.begin++ : --part.end;
        size += sizes_[item];
        ++piece.count;
    }
    if (!own) piece.first = part.end;
    part.left -= size, left_ -= size;
    return piece;
}

}  // namespace triad
