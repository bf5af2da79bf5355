// Writes the directional-albedo tables as text, at build time. Layout: kernels/types/materials.h.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include "albedo_integrals.h"

namespace triad::albedo {
namespace {

/// Values at the nodes of even axes over [0, 1], linear between them.
template <class Function>
class Table {
  public:
    /// The function takes a place of as many coordinates as there are axes.
    Table(std::vector<int> sizes, Function function) : sizes_(std::move(sizes)), function_(function) {
        int count = 1;
        for (int size : sizes_) count *= size;
        nodes_.resize(count);
        in_parallel([&](int i) { nodes_[i] = function_(place(i, 0)); });
    }
    /// Nodes around a cell whose middle is above the mean of its corners are raised by this share of it:
    /// lobes are divided by their albedo, so that what is between nodes may lose energy and not gain it.
    Table& raise(double share = 1) {
        const int corners = 1 << sizes_.size();
        std::vector<Pair> missing(nodes_.size());
        const auto corner = [&](int node, int k) {  // -1 beyond the table
            int stride = 1, at = node;
            for (std::size_t axis = sizes_.size(); axis-- > 0; stride *= sizes_[axis], node /= sizes_[axis])
                if (k >> axis & 1) {
                    if (node % sizes_[axis] + 1 == sizes_[axis]) return -1;
                    at += stride;
                }
            return at;
        };
        in_parallel([&](int i) {
            if (corner(i, corners - 1) < 0) return;
            Pair mean;
            for (int k = 0; k < corners; ++k) {
                mean.first += nodes_[corner(i, k)].first / corners;
                mean.second += nodes_[corner(i, k)].second / corners;
            }
            const Pair middle = function_(place(i, 0.5));
            missing[i] = {middle.first - mean.first, middle.second - mean.second};
        });
        std::vector<Pair> up(nodes_.size());
        for (int i = 0; i < int(nodes_.size()); ++i)
            for (int k = 0; k < corners; ++k)
                if (const int at = corner(i, k); at >= 0 && corner(i, corners - 1) >= 0) {
                    up[at].first = std::max(up[at].first, missing[i].first);
                    up[at].second = std::max(up[at].second, missing[i].second);
                }
        for (int i = 0; i < int(nodes_.size()); ++i)
            nodes_[i].first += share * up[i].first, nodes_[i].second += share * up[i].second;
        return *this;
    }
    /// As many values of each node as there are.
    void print(int values) const {
        for (Pair p : nodes_) {
            std::printf("%.8ef,\n", p.first);
            if (values > 1) std::printf("%.8ef,\n", p.second);
        }
    }

  private:
    std::vector<int> sizes_;
    Function function_;
    std::vector<Pair> nodes_;

    /// Coordinates of a node, or of a place beyond it, in steps.
    std::vector<double> place(int node, double beyond) const {
        std::vector<double> at(sizes_.size());
        for (std::size_t axis = sizes_.size(); axis-- > 0; node /= sizes_[axis])
            at[axis] = (node % sizes_[axis] + beyond) / (sizes_[axis] - 1);
        return at;
    }
    template <class Body>
    void in_parallel(Body body) const {
        const int threads = std::max(1, int(std::thread::hardware_concurrency()));
        std::vector<std::thread> all;
        for (int t = 0; t < threads; ++t)
            all.emplace_back([&, t] {
                for (int i = t; i < int(nodes_.size()); i += threads) body(i);
            });
        for (std::thread& thread : all) thread.join();
    }
};

/// Where alpha is 0 nothing is masked; columns are those of a small one, on which they do not depend.
double row(double roughness) { return std::max(roughness, 0.01); }
/// Cosine of a column.
double cosine(double v, double roughness) {
    const double root = v >= 1 ? 1 : roughness * v / (1 + roughness - v);
    return std::max(root * root, 1e-7);
}
Pair as_node(Pair p, double mu) { return {p.first, p.second / p.first - schlick(mu)}; }

Pair ggx_node(const std::vector<double>& at) {
    const double roughness = row(at[0]), mu = cosine(at[1], roughness);
    return as_node(ggx(mu, roughness * roughness), mu);
}
/// Index minus 1 at a place of its axis: nodes at even logarithms, linear between them.
double excess(double at) {
    const double step = std::log(double(ALBEDO_GLASS_MOST) / ALBEDO_GLASS_LEAST) / (ALBEDO_GLASS_INDICES - 1);
    const double node = std::floor(at * (ALBEDO_GLASS_INDICES - 1)),
                 t = at * (ALBEDO_GLASS_INDICES - 1) - node;
    return ALBEDO_GLASS_LEAST * std::exp(node * step) * (1 + t * (std::exp(step) - 1));
}
Pair glass_node(const std::vector<double>& at, bool inside) {
    const double index = 1 + excess(at[0]), roughness = row(at[1] * (at[1] + 1) / 2),
                 alpha = roughness * roughness;
    const double b = ALBEDO_GLASS_SCALE / (1 / alpha + 1 / (index - 1));
    const double mu = std::max(b * std::expm1(at[2] * std::log1p(1 / b)), 1e-7);
    return glass(std::min(mu, 1.0), alpha, inside ? 1 / index : index);
}
Pair stretched_node(const std::vector<double>& at) {
    const double alpha = std::max(at[0] * at[0], double(BSDF_SMOOTH_ALPHA)),
                 alpha_x = alpha + (1 - alpha) * at[1] * at[1];
    const auto slope = [](double c) { return std::sqrt(1 / (c * c) - 1); };  // its cosine is of x and z alone
    const double x = slope(cosine(at[2], std::sqrt(alpha_x))), y = slope(cosine(at[3], std::sqrt(alpha)));
    const double mu = 1 / std::sqrt(1 + x * x + y * y), phi = std::atan2(y, x);
    const double along = std::hypot(alpha_x * std::cos(phi), alpha * std::sin(phi));
    const Pair whole = stretched(mu, phi, alpha_x, alpha), round = ggx(mu, along, 48);
    return {whole.first, whole.second / whole.first - round.second / round.first};
}

Pair sheen_node(const std::vector<double>& at) {
    const double root = SHEEN_MIN_COSINE_ROOT + (1 - SHEEN_MIN_COSINE_ROOT) * at[1];
    return {sheen(std::pow(root, 4), SHEEN_MIN_ROUGHNESS + (1 - SHEEN_MIN_ROUGHNESS) * at[0] * at[0])};
}

}  // namespace
}  // namespace triad::albedo

int main() {
    using namespace triad::albedo;
    Table({ALBEDO_SIZE, ALBEDO_SIZE}, ggx_node).raise().print(2);
    for (bool inside : {false, true})
        Table({ALBEDO_GLASS_INDICES, ALBEDO_GLASS_ROUGHNESSES, ALBEDO_GLASS_COLUMNS},
              [inside](const auto& at) { return glass_node(at, inside); })
            .raise()
            .print(2);
    Table({ALBEDO_STRETCHED_ROUGHNESSES, ALBEDO_STRETCHED_STRENGTHS, ALBEDO_STRETCHED_SIZE,
           ALBEDO_STRETCHED_SIZE},
          stretched_node)
        .raise(0.75)  // the whole would cost more light than it saves
        .print(2);
    Table({ALBEDO_SHEEN_SIZE, ALBEDO_SHEEN_SIZE}, sheen_node).raise().print(1);
}
