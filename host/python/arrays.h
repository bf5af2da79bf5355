#pragma once
/// Between arrays of numpy and of the library.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "triad/image.h"

namespace triad::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style>;

/// An array of what the vector holds, which it owns from here on.
template <class Value>
py::array_t<Value> array_of(std::vector<Value>&& values, const std::vector<py::ssize_t>& shape) {
    auto owned = std::make_unique<std::vector<Value>>(std::move(values));
    const Value* data = owned->data();
    const py::capsule owner(owned.release(), [](void* v) { delete static_cast<std::vector<Value>*>(v); });
    return py::array_t<Value>(shape, data, owner);
}

inline py::array_t<float> array_of(triad::api::Image&& image) {
    return array_of(std::move(image.pixels), {py::ssize_t(image.height), image.width, image.channels});
}

inline py::array array_of(triad::api::Bitmap&& b) {
    const std::vector<py::ssize_t> shape{py::ssize_t(b.height), b.width, b.channels};
    py::array_t<std::uint8_t> bytes = array_of(std::move(b.bytes), {py::ssize_t(b.bytes.size())});
    if (b.bits == 8) return bytes.attr("reshape")(shape);
    return bytes.attr("view")("uint16").attr("reshape")(shape);
}

/// `encoded`: sRGB values, as of files of 8 or 16 bits.
inline triad::api::Image image_of(const Floats& array, bool encoded) {
    return {unsigned(array.shape(1)),
            unsigned(array.shape(0)),
            unsigned(array.shape(2)),
            {array.data(), array.data() + array.size()},
            encoded};
}

template <class Value>
std::span<const Value> span_of(const std::optional<py::array_t<Value, py::array::c_style>>& array) {
    return array ? std::span(array->data(), std::size_t(array->size())) : std::span<const Value>();
}

}  // namespace triad::python
