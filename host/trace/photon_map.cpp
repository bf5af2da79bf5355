#include "trace/photon_map.h"

#include <algorithm>
#include <bit>

namespace triad {
namespace {

constexpr std::size_t chunk = MAP_CHUNK;
/// Of the radius: how much wider cells are than the sphere that is searched, so that it never meets three.
constexpr double cell_margin = 1.05;

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

}  // namespace

PhotonMap::PhotonMap(Device& device, std::uint64_t photons)
    : device_(&device), buckets_(std::bit_ceil(std::max<std::size_t>(photons, 16 * chunk))) {
    const std::uint64_t records = photons * sizeof(dev::Photon), index = buckets_ * sizeof(std::uint32_t);
    const DeviceInfo& info = device.info();
    if ((info.max_allocation && std::max(records, index) > info.max_allocation) ||
        (info.memory && 2 * records + index > info.memory))
        throw Error(Exit::memory, "A map of " + std::to_string(photons) + " photons takes two pieces of " +
                                      mebibytes(records) + " and one of " + mebibytes(index) + "; " +
                                      info.name + " has " + mebibytes(info.memory) + ", at most " +
                                      mebibytes(info.max_allocation) +
                                      " in one piece. Ask for fewer --photons, and for more samples.");
    landed_ = device.allocate_array<dev::Photon>(photons);
    buffers_ = {device.allocate_array<dev::PhotonMap>(1), device.allocate_array<dev::Photon>(photons),
                device.allocate_array<std::uint32_t>(buckets_)};
    chunk_sums_ = device.allocate_array<std::uint32_t>(buckets_ / chunk);
}

void PhotonMap::compile(const Options& options) {
    const Program program = device_->build("photon/map.cl", options);
    count_ = program.kernel("count_photons");
    sum_chunks_ = program.kernel("sum_chunks");
    scan_chunks_ = program.kernel("scan_chunks");
    scan_buckets_ = program.kernel("scan_buckets");
    sort_ = program.kernel("sort_photons");
}

void PhotonMap::sort(dev::PhotonMap shape, std::uint64_t count) {
    shape.cells_per_unit = float(1 / (2 * cell_margin * double(shape.radius)));
    shape.bucket_mask = std::uint32_t(buckets_ - 1);
    device_->write(buffers_.map, &shape, sizeof shape);
    device_->fill_zero(buffers_.ends);
    const auto in_pieces = [&](const Kernel& kernel, const Arguments& arguments, std::size_t items) {
        for (std::size_t first = 0; first < items; first += largest_launch_items)
            device_->run(kernel, Arguments().add(arguments).add(std::uint32_t(first)),
                         std::min(items - first, largest_launch_items));
    };
    const std::size_t chunks = buckets_ / chunk;
    const Arguments records = Arguments().add(buffers_.map).add(landed_).add(std::uint32_t(count));
    const Arguments counts = Arguments().add(buffers_.ends).add(std::uint32_t(chunks)).add(chunk_sums_);
    in_pieces(count_, Arguments().add(records).add(buffers_.ends), count);
    in_pieces(sum_chunks_, counts, chunks);
    device_->run(scan_chunks_, counts, 1);
    in_pieces(scan_buckets_, counts, chunks);
    in_pieces(sort_, Arguments().add(records).add(buffers_.ends).add(buffers_.photons), count);
}

std::uint64_t PhotonMap::bytes() const {
    return landed_.bytes() + chunk_sums_.bytes() + buffers_.map.bytes() + buffers_.photons.bytes() +
           buffers_.ends.bytes();
}

}  // namespace triad
