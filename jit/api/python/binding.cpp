// Shaders on arrays: what is called for every batch.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "jit/api/python/bound_arrays.h"
#include "jit/api/python/errors.h"
#include "jit/api/python/index_list.h"
#include "jit/api/python/module.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

std::uint64_t count_of(const BoundArrays& self, nacre_entry entry,
                       const std::optional<std::uint64_t>& asked, const IndexList& points) {
  if (asked) {
    if (points.is_given() && *asked > points.size()) {
      refuse("short-array", "points", "'points' is shorter than the count",
             std::to_string(*asked) + " elements", std::to_string(points.size()));
    }
    return *asked;
  }
  if (points.is_given()) return points.size();
  const std::uint64_t count = self.count(entry);
  if (count != Placement::endless) return count;
  refuse("no-count", "count", "no array says how many points there are", "a count", "none");
}

bool run(const BoundArrays& self, nacre_entry entry, const std::optional<std::uint64_t>& count,
         nb::handle points, nb::handle instances, const Instance* instance, std::uint32_t point,
         const Stop* stop) {
  const IndexList picked(points, "points");
  const IndexList of_points(instances, "instances");
  Request request;
  request.count = count_of(self, entry, count, picked);
  request.points = picked.data();
  request.instances = of_points.data();
  request.instance_count = of_points.size();
  request.instance = instance != nullptr ? instance->get() : nullptr;
  request.stop = stop != nullptr ? stop->flag() : nullptr;
  request.point = point;
  self.check(entry, request);
  return self.run(entry, request);
}

}  // namespace

void bind_binding(nb::module_& module) {
  nb::class_<Stop>(module, "Stop",
                   "A flag that ends runs within some milliseconds, whichever thread sets it.")
      .def(nb::init<>())
      .def("set", &Stop::set, "Ends runs, those that begin later too.")
      .def("clear", &Stop::clear, "Lets runs begin again.")
      .def("is_set", &Stop::is_set);

  nb::class_<BoundArrays>(module, "Binding",
                          "A shader's kernels on arrays: what Shader.bind() gives. Keeps the "
                          "arrays alive, and refers to their memory as it was then.")
      .def(
          "__init__",
          [](BoundArrays* self, const Shader& shader, const nb::list& arrays,
             std::uint32_t entries) {
            std::vector<NamedArray> named;
            for (nb::handle each : arrays) {
              const auto [name, object, element] =
                  nb::cast<std::tuple<std::string, nb::object, int>>(each);
              named.push_back({name, object, element});
            }
            new (self) BoundArrays(shader, named, entries);
          },
          nb::arg("shader"), nb::arg("arrays"), nb::arg("entries"))
      .def(
          "count",
          [](const BoundArrays& self, nacre_entry entry) -> std::optional<std::uint64_t> {
            const std::uint64_t count = self.count(entry);
            if (count == Placement::endless) return std::nullopt;
            return count;
          },
          nb::arg("entry"),
          "Points of the shortest array that the entry takes; None where all are constants.")
      .def_prop_ro(
          "length",
          [](const BoundArrays& self) -> std::optional<std::uint64_t> {
            const std::uint64_t length = self.length();
            if (length == Placement::endless) return std::nullopt;
            return length;
          },
          "Points of the shortest of all arrays, read by an entry or not; None where all are "
          "constants.")
      .def("run", run, nb::arg("entry"), nb::arg("count") = nb::none(), nb::kw_only(),
           nb::arg("points") = nb::none(), nb::arg("instances") = nb::none(),
           nb::arg("instance").none() = nb::none(), nb::arg("point") = 0,
           nb::arg("stop").none() = nb::none(),
           nb::sig("def run(self, entry: Entry, count: int | None = None, *, "
                   "points: object = None, instances: object = None, "
                   "instance: Instance | None = None, point: int = 0, "
                   "stop: Stop | None = None) -> bool"),
           R"(Shades `count` points, by default as many as the arrays have; False if it was stopped.

points     uint32 array: which ones, `count` of them; fastest in ascending order.
instances  uint32 array: for every point, the element of arrays bound by of_instance().
instance   values of the parameters; None: the document's.
point      for EVALUATE_AT: the point that the directions belong to.

Other threads of Python run meanwhile, and signals (Ctrl-C) are seen every 65,536 points. An entry
that the shader lacks computes nothing. Error where an array is too short.)");
}

}  // namespace nacre::python
