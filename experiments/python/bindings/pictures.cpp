#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <future>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/python/bindings/bindings.hpp"
#include "experiments/python/bindings/scalars.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/trace/render.hpp"

namespace py = pybind11;

namespace bindings {
namespace {

template <class T>
py::array_t<T> make_array(int height, int width) {
  return py::array_t<T>({height, width, 3});
}

py::array_t<std::uint8_t> to_array(int width, int height, const std::vector<std::uint8_t>& rgb8) {
  auto array = make_array<std::uint8_t>(height, width);
  std::ranges::copy(rgb8, array.mutable_data());
  return array;
}

// The default parameters of a picture, with a faster traversal that yields the same picture.
// Experiments use the thesis's traversal, because they count its steps.
renderer::Params standard_params() {
  renderer::Params params;
  params.traversal = renderer::Traversal::nearest;
  return params;
}

renderer::Params read_params(const py::dict& options) {
  auto params = standard_params();
  const auto fields = renderer::param_fields();
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    const auto field = std::ranges::find(fields, name, &base::Field<renderer::Params>::name);
    if (field == fields.end()) {
      std::vector<std::string> names;
      for (const auto& f : fields) names.push_back(f.name);
      base::refuse("render", "unknown option \"{}\"{}", name, base::suggest(name, names));
    }
    const auto expected = field->assign(params, from_python(name, value));
    base::require(expected.empty(), name, "found {}, expected {}",
                  py::repr(value).cast<std::string>(), expected);
  }
  return params;
}

// Calls `work` in another thread, and lets Python handle its signals meanwhile. After an interrupt
// (Ctrl-C), sets `is_stopped`, waits for the end of `work`, and throws KeyboardInterrupt. Signals
// reach Python only in its main thread.
template <class Work>
auto run_interruptible(std::atomic<bool>& is_stopped, const Work& work) {
  constexpr std::chrono::milliseconds PERIOD{50};
  auto result = std::async(std::launch::async, work);
  while (true) {
    {
      const py::gil_scoped_release others_may_run;
      if (result.wait_for(PERIOD) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    is_stopped = true;
    const py::error_already_set interrupt;  // takes the exception from Python
    {
      const py::gil_scoped_release others_may_run;
      result.wait();
    }
    throw interrupt;
  }
  return result.get();
}

// Renders the picture, with 8 bits per colour, or as linear light if `is_linear`: 1 is white, and
// values may exceed 1.
py::array render(const std::string& source, const py::dict& options, int threads, bool is_linear) {
  const auto params = read_params(options);
  renderer::LeftOut left_out;
  std::atomic<bool> is_stopped = false;
  const auto image = run_interruptible(is_stopped, [&] {
    return renderer::render(renderer::load_scene(source, 0, &left_out), params, threads, {},
                            [&] { return is_stopped.load(); });
  });
  for (const auto& sentence : left_out.describe_all(source))
    if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0) throw py::error_already_set();
  if (!is_linear) return to_array(params.width, params.height, make_rgb8(image.samples));
  auto array = make_array<double>(params.height, params.width);
  auto* at = array.mutable_data();
  for (const auto& sums : image.samples.sums) {
    const auto colour = renderer::to_rgb(sums);
    for (const double part : {colour.r, colour.g, colour.b}) *at++ = part;
  }
  return array;
}

py::array_t<std::uint8_t> load_picture(const std::string& path) {
  const auto picture = renderer::load_png(path);
  return to_array(picture.width, picture.height, picture.rgb8);
}

}  // namespace

void bind_pictures(py::module_& module) {
  module.def("render", &render);
  module.def("load_picture", &load_picture);
  module.def("render_options", [] {
    py::list options;
    for (const auto& field : renderer::param_fields())
      options.append(describe(field, standard_params()));
    return options;
  });
}

}  // namespace bindings
