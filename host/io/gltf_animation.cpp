#include "io/gltf_animation.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "io/gltf_accessor.h"

namespace triad::gltf {
namespace {

std::vector<float> read_times(File& file, int accessor, const std::string& what) {
    std::vector<float> times = read_floats(file, accessor, 1, Integers::none, what + ": input");
    if (times.empty()) throw Error(Exit::scene, what + " has no key frames.");
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
            throw Error(Exit::scene, what + ": the time of key frame " + std::to_string(i) +
                                         " is no number, or not later than the one before it.");
    return times;
}

Interpolation interpolation_of(const std::string& name, const std::string& what) {
    if (name.empty() || name == "LINEAR") return Interpolation::linear;
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    throw Error(Exit::scene, what + " has the unknown interpolation '" + name.substr(0, 40) + "'.");
}

std::size_t morph_targets(const File& file, const Node& node) {
    if (node.mesh < 0) return 0;
    const auto& primitives = file.model.meshes[std::size_t(node.mesh)].primitives;
    return primitives.empty() ? 0 : primitives.front().targets.size();
}

dvec3 vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// One channel of an animation.
class Channel {
  public:
    Channel(File& file, const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
            const std::string& animation_name)
        : file_(file),
          channel_(channel),
          node_(file.nodes[std::size_t(channel.target_node)]),
          what_(animation_name + ", " + channel.target_path.substr(0, 40) + " of " +
                label("node", std::size_t(channel.target_node), node_.name)) {
        if (channel.sampler < 0 || std::size_t(channel.sampler) >= animation.samplers.size())
            throw Error(Exit::scene, what_ + " has no sampler.");
        sampler_ = &animation.samplers[std::size_t(channel.sampler)];
    }

    void apply(double seconds, NodePose& pose) const {
        const std::string& path = channel_.target_path;
        if (path == "weights") {
            const std::size_t targets = morph_targets(file_, node_);
            if (targets > 0) pose.weights = sample(seconds, 1, targets, Integers::any_normalised);
            return;
        }
        if (!node_.matrix.empty()) return file_.warn(what_ + ": the node has a matrix; it is not animated.");
        if (path == "translation")
            pose.translation = vector(sample(seconds, 3, 1, Integers::none));
        else if (path == "scale")
            pose.scale = vector(sample(seconds, 3, 1, Integers::none));
        else if (path == "rotation") {
            const std::vector<double> q = sample(seconds, 4, 1, Integers::any_normalised);
            pose.rotation = unit_quaternion(dquat(q[3], q[0], q[1], q[2]), what_);
        } else {
            file_.warn(what_ + " is nothing that is animated here; it is left out.");
        }
    }

  private:
    /// `elements` of `components` numbers for every key frame.
    std::vector<double> sample(double seconds, int components, std::size_t elements,
                               Integers integers) const {
        const Interpolation interpolation = interpolation_of(sampler_->interpolation, what_);
        const std::vector<float> times = read_times(file_, sampler_->input, what_);
        const std::vector<float> values =
            read_floats(file_, sampler_->output, components, integers, what_ + ": output");
        const std::size_t width = std::size_t(components) * elements,
                          wanted = times.size() * width * (interpolation == Interpolation::cubic ? 3 : 1);
        if (values.size() != wanted)
            throw Error(Exit::scene, what_ + " has " + std::to_string(values.size() / unsigned(components)) +
                                         " values but needs " +
                                         std::to_string(wanted / unsigned(components)) + " for its " +
                                         std::to_string(times.size()) + " key frames.");
        return interpolate(times, values, width, seconds, interpolation, components == 4);
    }

    File& file_;
    const tinygltf::AnimationChannel& channel_;
    const Node& node_;
    std::string what_;
    const tinygltf::AnimationSampler* sampler_;
};

std::string name_of(const File& file, int animation) {
    return label("animation", std::size_t(animation), file.model.animations[std::size_t(animation)].name);
}

}  // namespace

int choose_animation(const File& file, const std::string& choice) {
    const auto& animations = file.model.animations;
    if (choice.empty()) return animations.empty() ? -1 : 0;
    for (std::size_t i = 0; i < animations.size(); ++i)
        if (animations[i].name == choice) return int(i);
    if (choice == "none") return -1;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size() && index < animations.size())
        return int(index);
    std::string sentence = "--animation " + choice + ": there is no such animation; the file has ";
    if (animations.empty()) throw Error(Exit::usage, sentence + "none.");
    for (std::size_t i = 0; i < animations.size(); ++i)
        sentence += (i ? ", " : "") + std::to_string(i) + " \"" + animations[i].name + '"';
    throw Error(Exit::usage, sentence + ".");
}

double length_of(File& file, int animation) {
    double length = 0;
    for (const auto& sampler : file.model.animations[std::size_t(animation)].samplers)
        length = std::max(length, double(read_times(file, sampler.input, name_of(file, animation)).back()));
    return length;
}

Pose pose_at(File& file, int animation, double seconds) {
    Pose pose;
    if (animation < 0) return pose;
    const tinygltf::Animation& source = file.model.animations[std::size_t(animation)];
    for (const tinygltf::AnimationChannel& channel : source.channels)
        if (channel.target_node >= 0)
            Channel(file, source, channel, name_of(file, animation))
                .apply(seconds, pose[channel.target_node]);
    return pose;
}

}  // namespace triad::gltf
