// The Python module triad._triad: the library's calls on plain arrays. What users see is made of it in
// triad/__init__.py.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "triad/triad.h"

namespace py = pybind11;
namespace api = triad::api;

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;  // options in the order of their names
using triad::python::array_of, triad::python::Floats, triad::python::image_of, triad::python::span_of;

api::Options options_of(const Words& words) { return {words.begin(), words.end()}; }

/// The arrays of a mesh, which live as long.
struct Mesh {
    std::string name;
    Floats positions;
    py::array_t<std::uint32_t, py::array::c_style> indices;
    std::optional<Floats> normals, uvs;
    std::size_t material;
    std::array<double, 16> to_world;

    api::Mesh shown() const {
        return {name,
                {positions.data(), std::size_t(positions.size())},
                {indices.data(), std::size_t(indices.size())},
                span_of(normals),
                span_of(uvs),
                material,
                to_world};
    }
};

struct Material {
    api::Material factors;
    std::optional<py::array_t<std::uint8_t, py::array::c_style>> texture;

    api::Material shown() const {
        api::Material all = factors;
        if (texture)
            all.base_colour_texture =
                api::Texture{unsigned(texture->shape(1)), unsigned(texture->shape(0)), span_of(texture)};
        return all;
    }
};

api::Scene make_scene(const std::vector<Mesh>& meshes, const std::vector<Material>& materials,
                      const std::optional<api::Camera>& camera) {
    std::vector<api::Mesh> all_meshes;
    std::vector<api::Material> all_materials;
    for (const Mesh& mesh : meshes) all_meshes.push_back(mesh.shown());
    for (const Material& material : materials) all_materials.push_back(material.shown());
    const py::gil_scoped_release release;
    return api::make_scene(all_meshes, all_materials, camera);
}

/// Calls Python: nothing but False stops; an exception does, and Ctrl-C.
template <class Row>
std::function<bool(const Row&)> report_to(const py::object& report) {
    return [&report](const Row& row) {
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return report.is_none() || report(row).ptr() != Py_False;
    };
}

api::Film render(const std::variant<api::Scene, std::filesystem::path>& scene, unsigned width,
                 unsigned height, std::optional<std::uint64_t> spp, std::uint32_t seed,
                 const std::string& device, const Words& options, const py::object& report) {
    const api::Settings settings{width, height, spp, seed, device, options_of(options)};
    const auto call = report_to<api::Progress>(report);
    const py::gil_scoped_release release;
    return std::visit([&](const auto& of) { return api::render(of, settings, call); }, scene);
}

std::vector<api::CheckResult> check(const std::string& device, const std::string& level,
                                    const std::vector<std::string>& cases, const py::object& report) {
    const auto call = report_to<api::CheckResult>(report);
    const py::gil_scoped_release release;
    return api::check(device, level, cases, call);
}

py::array_t<float> reconstruct(const Floats& bins, bool encoded, const Words& options) {
    api::Image image = image_of(bins, encoded);
    {
        const py::gil_scoped_release release;
        image = api::reconstruct(image, options_of(options));
    }
    return array_of(std::move(image));
}

/// What a film or a file gives without the interpreter, as an array.
template <class Work>
auto array_from(const Work& work) {
    auto made = [&] {
        const py::gil_scoped_release release;
        return work();
    }();
    return array_of(std::move(made));
}

py::dict layers_of(const api::Film& film) {
    py::dict layers;
    for (const auto& [name, values] : film.layers())
        layers[py::str(name)] =
            array_of(std::vector<float>(values), {py::ssize_t(film.height()), film.width()});
    return layers;
}

py::tuple read_image(const std::filesystem::path& path) {
    api::Image image = [&] {
        const py::gil_scoped_release release;
        return api::read_image(path);
    }();
    const bool encoded = image.encoded;
    return py::make_tuple(array_of(std::move(image)), encoded);
}

/// triad.Error, with the exit code of the command line.
void add_error(py::module_& module) {
    static const py::handle type = py::exception<api::Error>(module, "Error", PyExc_RuntimeError).release();
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const api::Error& error) {
            const py::object made = type(error.what());
            made.attr("exit_code") = error.exit_code();
            PyErr_SetObject(type.ptr(), made.ptr());
        }
    });
}

void add_rows(py::module_& module) {
    py::class_<api::Progress>(module, "Progress")
        .def_readonly("done", &api::Progress::done)
        .def_readonly("seconds", &api::Progress::seconds)
        .def_readonly("seconds_left", &api::Progress::seconds_left)
        .def_readonly("spp", &api::Progress::spp)
        .def_readonly("relmse", &api::Progress::relmse);
    py::class_<api::Comparison>(module, "Comparison")
        .def_readonly("rmse", &api::Comparison::rmse)
        .def_readonly("relmse", &api::Comparison::relmse)
        .def_readonly("mae", &api::Comparison::mae)
        .def_readonly("psnr", &api::Comparison::psnr)
        .def_readonly("flip", &api::Comparison::flip);
    py::class_<api::Perceived>(module, "Perceived")
        .def_readonly("error", &api::Perceived::error)
        .def_readonly("lightness", &api::Perceived::lightness)
        .def_readonly("colour", &api::Perceived::colour)
        .def_readonly("de_mean", &api::Perceived::de_mean)
        .def_readonly("de_p95", &api::Perceived::de_p95);
    py::class_<api::Device>(module, "Device")
        .def_readonly("index", &api::Device::index)
        .def_readonly("name", &api::Device::name)
        .def_readonly("platform", &api::Device::platform)
        .def_readonly("driver", &api::Device::driver)
        .def_readonly("type", &api::Device::type)
        .def_readonly("compute_units", &api::Device::compute_units)
        .def_readonly("memory", &api::Device::memory)
        .def_readonly("usable", &api::Device::usable)
        .def_readonly("chosen", &api::Device::chosen)
        .def_readonly("why_unusable", &api::Device::why_unusable);
    py::class_<api::Panel>(module, "Panel")
        .def_readonly("name", &api::Panel::name)
        .def_readonly("description", &api::Panel::description);
    py::class_<api::CheckResult>(module, "CheckResult")
        .def_readonly("name", &api::CheckResult::name)
        .def_readonly("value", &api::CheckResult::value)
        .def_readonly("bound", &api::CheckResult::bound)
        .def_readonly("right", &api::CheckResult::right)
        .def_readonly("faults", &api::CheckResult::faults)
        .def_readonly("seconds", &api::CheckResult::seconds);
}

void add_scene(py::module_& module) {
    py::class_<Mesh>(module, "Mesh")
        .def(py::init<std::string, Floats, py::array_t<std::uint32_t, py::array::c_style>,
                      std::optional<Floats>, std::optional<Floats>, std::size_t, std::array<double, 16>>());
    py::class_<Material>(module, "Material")
        .def(py::init([](const std::string& name, const std::array<float, 4>& base_colour,
                         const std::optional<py::array_t<std::uint8_t, py::array::c_style>>& texture,
                         float metallic, float roughness, const std::array<float, 3>& emission,
                         float transmission, float thickness, float ior, bool double_sided) {
            return Material{{name,
                             base_colour,
                             {},
                             metallic,
                             roughness,
                             emission,
                             transmission,
                             thickness,
                             ior,
                             double_sided},
                            texture};
        }));
    py::class_<api::Camera>(module, "Camera")
        .def(py::init<std::array<double, 3>, std::array<double, 3>, std::array<double, 3>, double>());
    py::class_<api::Scene>(module, "Scene")
        .def(py::init(), py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("name", &api::Scene::name)
        .def_property_readonly("triangles", &api::Scene::triangles)
        .def_property_readonly("instances", &api::Scene::instances)
        .def_property_readonly("materials", &api::Scene::materials)
        .def_property_readonly("cameras", &api::Scene::cameras)
        .def_property_readonly("bounds", &api::Scene::bounds)
        .def_property_readonly("warnings", &api::Scene::warnings);
    module.def(
        "load",
        [](const std::filesystem::path& path, const Words& options) {
            return api::load(path, options_of(options));
        },
        py::call_guard<py::gil_scoped_release>());
    module.def("make_scene", &make_scene);
}

void add_film(py::module_& module) {
    py::class_<api::Film>(module, "Film")
        .def_property_readonly("width", &api::Film::width)
        .def_property_readonly("height", &api::Film::height)
        .def_property_readonly("spp", &api::Film::spp)
        .def_property_readonly("relmse", &api::Film::relmse)
        .def_property_readonly("complete", &api::Film::complete)
        .def_property_readonly("metadata", &api::Film::metadata)
        .def_property_readonly("layers", &layers_of)
        .def("image",
             [](const api::Film& film, const Words& options) {
                 return array_from([&] { return film.image(options_of(options)); });
             })
        .def("bitmap",
             [](const api::Film& film, const Words& options) {
                 return array_from([&] { return film.bitmap(options_of(options)); });
             })
        .def(
            "write",
            [](const api::Film& film, const std::vector<std::filesystem::path>& paths, const Words& options) {
                film.write(paths, options_of(options));
            },
            py::call_guard<py::gil_scoped_release>())
        .def("encode",
             [](const api::Film& film, const std::string& extension, const Words& options) {
                 const std::vector<std::uint8_t> bytes = [&] {
                     const py::gil_scoped_release release;
                     return film.encode(extension, options_of(options));
                 }();
                 return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
             })
        .def("save", &api::Film::save, py::call_guard<py::gil_scoped_release>());
    module.def("load_film", &api::load_film, py::call_guard<py::gil_scoped_release>());
    module.def("merge", &api::merge, py::call_guard<py::gil_scoped_release>());
}

}  // namespace

// Whatever waits for another call of the library releases the interpreter, which that call's report may want.
PYBIND11_MODULE(_triad, module) {
    add_error(module);
    add_rows(module);
    add_scene(module);
    add_film(module);
    module.def("render", &render);
    module.def("read_image", &read_image);
    module.def("compare", [](const Floats& picture, bool picture_encoded, const Floats& reference,
                             bool reference_encoded) {
        const api::Image a = image_of(picture, picture_encoded), b = image_of(reference, reference_encoded);
        const py::gil_scoped_release release;
        return api::compare(a, b);
    });
    module.def("perceived", [](const Floats& drives, bool drives_encoded, const Floats& reference,
                               bool reference_encoded, const std::string& panel, double ppd,
                               const std::string& eye) {
        const api::Image a = image_of(drives, drives_encoded), b = image_of(reference, reference_encoded);
        const py::gil_scoped_release release;
        return api::perceived(a, b, panel, ppd, eye);
    });
    module.def("reconstruct", &reconstruct);
    module.def("devices", &api::devices, py::call_guard<py::gil_scoped_release>());
    module.def("panels", &api::panels, py::call_guard<py::gil_scoped_release>());
    module.def("check", &check);
    module.def("version", &api::version);
    module.def("set_verbosity", &api::set_verbosity);
}
