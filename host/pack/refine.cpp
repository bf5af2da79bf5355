#include "pack/refine.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace triad {
namespace {

template <class Vector>
void append_middle(std::vector<Vector>& list, unsigned a, unsigned b) {
    if (list.empty()) return;
    const Vector middle = (list[a] + list[b]) * typename Vector::value_type(0.5);
    list.push_back(middle);
}

class Refiner {
  public:
    Refiner(Primitive& primitive, std::vector<dvec3>& positions, const Cutter& cutter)
        : p_(primitive), positions_(positions), cutter_(cutter) {}

    void cut(const uvec3& triangle) {
        unsigned cut_count = 0;
        std::array<bool, 3> cut_edge;  // edge i lies opposite to corner i
        for (int i = 0; i < 3; ++i) {
            cut_edge[std::size_t(i)] =
                cutter_.cuts(positions_[triangle[(i + 1) % 3]], positions_[triangle[(i + 2) % 3]]);
            cut_count += cut_edge[std::size_t(i)];
        }
        if (cut_count == 0) {
            done_.push_back(triangle);
            return;
        }
        // Turned so that the single edge that is cut, or is not, lies opposite to corner a.
        int turn = 0;
        if (cut_count < 3)
            while (cut_edge[std::size_t(turn)] != (cut_count == 1)) ++turn;
        const unsigned a = triangle[turn], b = triangle[(turn + 1) % 3], c = triangle[(turn + 2) % 3];
        if (cut_count == 1) {
            const unsigned bc = middle(b, c);
            cut({a, b, bc}), cut({a, bc, c});
            return;
        }
        const unsigned ab = middle(a, b), ca = middle(c, a);
        cut({a, ab, ca});
        if (cut_count == 3) {
            const unsigned bc = middle(b, c);
            cut({ab, b, bc}), cut({ca, bc, c}), cut({ab, bc, ca});
            return;
        }
        const dvec3 &pb = positions_[b], &pc = positions_[c];
        if (std::tie(pb.x, pb.y, pb.z) < std::tie(pc.x, pc.y, pc.z))
            cut({b, ca, ab}), cut({b, c, ca});
        else
            cut({c, ca, ab}), cut({c, ab, b});
    }

    void take() { p_.triangles = std::move(done_); }

  private:
    unsigned middle(unsigned a, unsigned b) {
        positions_.push_back(0.5 * (positions_[a] + positions_[b]));
        append_middle(p_.normals, a, b);
        if (!p_.tangents.empty()) {
            vec4 tangent = 0.5f * (p_.tangents[a] + p_.tangents[b]);
            tangent.w = p_.tangents[a].w;
            p_.tangents.push_back(tangent);
        }
        append_middle(p_.uvs[0], a, b);
        append_middle(p_.uvs[1], a, b);
        append_middle(p_.colours, a, b);
        return unsigned(positions_.size() - 1);
    }

    Primitive& p_;
    std::vector<dvec3>& positions_;
    const Cutter& cutter_;
    std::vector<uvec3> done_;
};

}  // namespace

Cutter::Cutter(const dvec3& eye, double reach, double longest)
    : eye_(eye), least_(0x1p-30 * reach), longest_(longest) {}

bool Cutter::cuts(const dvec3& a, const dvec3& b) const {
    const bool ordered = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    const dvec3 &from = ordered ? a : b, &to = ordered ? b : a;  // the same bits from either side
    const dvec3 edge = to - from, offset = eye_ - from;
    const double length2 = glm::dot(edge, edge);
    if (!(length2 > least_ * least_)) return false;
    const dvec3 away = offset - edge * std::clamp(glm::dot(offset, edge) / length2, 0.0, 1.0);
    return length2 > longest_ * longest_ * glm::dot(away, away);
}

bool Cutter::cuts_any(const dvec3& a, const dvec3& b, const dvec3& c) const {
    const double longest2 =
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    const double factor = 1.0 + 1.0 / longest_;
    if (glm::dot(eye_ - a, eye_ - a) > factor * factor * longest2) return false;  // too far away for any edge
    return cuts(a, b) || cuts(b, c) || cuts(c, a);
}

bool needs_refining(const Primitive& primitive, const std::vector<dvec3>& positions, const dvec3& eye,
                    double reach) {
    const Cutter cutter(eye, reach);
    return std::any_of(primitive.triangles.begin(), primitive.triangles.end(), [&](const uvec3& t) {
        return cutter.cuts_any(positions[t.x], positions[t.y], positions[t.z]);
    });
}

void refine(Primitive& primitive, std::vector<dvec3>& positions, const dvec3& eye, double reach) {
    const Cutter cutter(eye, reach);
    Refiner refiner(primitive, positions, cutter);
    const std::vector<uvec3> triangles = primitive.triangles;
    for (const uvec3& t : triangles) refiner.cut(t);
    refiner.take();
}

}  // namespace triad
