#pragma once
/// Reference pictures with variances, kept in pictures/: means of many films of other seeds, each as large as
/// those that are compared with them, so that what depends on the number of samples (the radius of photons)
/// is the same in both.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "metric/mean_test.h"
#include "scene/film.h"

namespace triad {

/// A row of pictures.txt.
struct KeptCase {
    std::string name, options;  ///< of triad render
};
const std::vector<KeptCase>& kept_cases();
/// Throws std::out_of_range for a name that there is not.
const KeptCase& kept_case(std::string_view name);

struct KeptPicture {
    unsigned width = 0, height = 0;
    unsigned films = 0;   ///< that it is the mean of
    double samples = 0;   ///< per pixel, of all films together
    bool shared = false;  ///< pixels of a film share noise (gathered photons): `variance` adds up to that of
                          ///< tiles, which has as many degrees of freedom as there are films but one
    std::vector<float> mean, variance;  ///< [pixel][R, G, B]; variance: of the mean
};

/// Gathers films of different seeds.
class KeptPictureMaker {
  public:
    void add(const Film& film);
    /// `shared`: as in KeptPicture.
    KeptPicture make(bool shared) const;

  private:
    /// Of values less the first one, so that those without noise have none.
    struct Moments {
        double first = 0, sum = 0, squares = 0;
        void add(double value, bool is_first);
        double mean(double n) const { return first + sum / n; }
        double variance(double n) const;  ///< of the mean of n values
    };
    unsigned width_ = 0, height_ = 0, films_ = 0;
    double samples_ = 0;
    std::vector<Moments> pixels_, tiles_;  ///< [pixel or tile][channel]; the last tile is the whole picture

    /// Variance of tiles over what their pixels' variances add up to.
    std::vector<double> tile_ratios() const;
};

std::filesystem::path kept_picture_file(const std::string& name);
void save(const std::filesystem::path& path, const KeptPicture& picture);
KeptPicture load_kept_picture(const std::filesystem::path& path);

/// For test_means().
TileMeans tile_means(const KeptPicture& picture);

/// An EXR of the films' mean (R, G, B), the reference, and by how many standard errors they differ (error.R,
/// ...).
void save_difference(const std::filesystem::path& path, const KeptPicture& found,
                     const KeptPicture& reference);

}  // namespace triad
