#pragma once
/// Bounding volume hierarchies in the layouts of kernels/types.h: binned SAH on all cores, collapsed to four
/// or eight children.
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/aligned_vector.h"
#include "base/math.h"
#include "kernels/types.h"

namespace triad {

/// The layouts of nodes. Hits are the same bit for bit, whichever a device walks.
enum class BvhFormat {
    bvh8,  ///< dev::Bvh8Node: eight boxes at once, for vector units within an item (CPUs)
    bvh4   ///< dev::Bvh4Node: four boxes on a grid of bytes, one at a time: a quarter of the bytes (GPUs)
};
using BvhFormats = std::set<BvhFormat>;
inline const BvhFormats all_bvh_formats{BvhFormat::bvh8, BvhFormat::bvh4};

/// What they are called on the command line, in pictures and in JSON.
const char* name_of(BvhFormat format);
std::optional<BvhFormat> find_bvh_format(const std::string& name);

/// Indices of a tree's root among the nodes of each format, by the format's number; TRIAD_NONE where there
/// are none.
using BvhRoots = std::array<std::uint32_t, BVH_FORMATS>;

/// Trees over one pool of nodes and blocks, so that instances of many meshes share the arrays of the device.
struct BvhPool {
    BvhFormats formats = all_bvh_formats;  ///< that trees are built in
    AlignedVector<dev::Bvh8Node> nodes8;
    AlignedVector<dev::Bvh4Node> nodes4;
    AlignedVector<dev::TriangleBlock> blocks;  ///< the leaves of all formats
};

/// What a tree is built over. Corners in the space of the tree; primitive = index into the scene's Triangle
/// array.
struct BvhTriangle {
    vec3 corner[3];
    std::uint32_t primitive;
    bool opaque = false;         ///< true: rays that hit it never ask for its coverage (alpha)
    std::uint32_t geometry = 0;  ///< index into the scene's Geometry array, carried along
};

/// A box of the top level that stands for an instance.
struct BvhInstance {
    Bounds bounds;  ///< in rebased world space
    std::uint32_t instance;
};

/// Builds one tree, appends it to `pool` and returns its root nodes. Takes triangles and instances over: they
/// are freed as soon as they are not needed. Deterministic, whatever the number of threads and the other
/// formats. Exact duplicates (the same three corners) keep the lowest primitive only. `origin_reach` is the
/// largest coordinate that a ray origin may have in this space: boxes are padded for rounding at that
/// magnitude. Left out: triangles without area, and what has a coordinate that is no number or beyond 2^125
/// (validate() refuses such scenes long before). An empty tree is a root whose children are all BVH_EMPTY.
BvhRoots build_bvh(std::vector<BvhTriangle> triangles, std::vector<BvhInstance> instances, float origin_reach,
                   BvhPool& pool);

}  // namespace triad
