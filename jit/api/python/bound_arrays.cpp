#include "jit/api/python/bound_arrays.h"

#include <algorithm>
#include <string_view>

#include "jit/api/python/errors.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

/// Past the greatest element of a list.
std::uint64_t past(const std::uint32_t* list, std::uint64_t count) {
  std::uint32_t most = 0;
  for (std::uint64_t i = 0; i < count; ++i) most = std::max(most, list[i]);
  return count == 0 ? 0 : std::uint64_t{most} + 1;
}

/// Past the greatest instance of the points that are shaded.
std::uint64_t past_instances_of(const Request& request) {
  if (request.points == nullptr) return past(request.instances, request.count);
  std::uint64_t most = 0;
  for (std::uint64_t i = 0; i < request.count; ++i) {
    most = std::max(most, std::uint64_t{request.instances[request.points[i]]} + 1);
  }
  return most;
}

[[noreturn]] void refuse_length(const std::string& name, std::uint64_t expected,
                                std::uint64_t found) {
  refuse("short-array", name, "'" + name + "' is too short for what is to be shaded",
         std::to_string(expected) + " elements", std::to_string(found));
}

[[noreturn]] void refuse_name(const Shader& shader, std::uint32_t entries,
                              const std::string& name) {
  std::string results;
  std::vector<std::string> known;
  const auto add = [&](const Channel& each) {
    if (each.role == NACRE_STATE) return;
    known.push_back(each.name);
    // By "uv0" of "uv0.x" arrays are bound as well.
    if (each.component >= 0) known.push_back(each.name.substr(0, each.name.rfind('.')));
  };
  for (int i = 0; i < NACRE_ENTRY_COUNT; ++i) {
    const auto entry = static_cast<nacre_entry>(i);
    if ((entries >> i & 1) == 0) continue;
    for (const Channel& each : shader.inputs(entry)) add(each);
    for (const Channel& each : shader.results(entry)) {
      add(each);
      if (each.role != NACRE_STATE) results += (results.empty() ? "" : ", ") + each.name;
    }
  }
  refuse("unknown-channel", name, "there is no channel '" + name + "'",
         "a channel, a varying parameter, or a result: " + results, "", near_hint(name, known));
}

}  // namespace

BoundArrays::BoundArrays(const Shader& shader, const std::vector<NamedArray>& arrays,
                         std::uint32_t entries) {
  std::uint32_t present = 0;
  for (int i = 0; i < NACRE_ENTRY_COUNT; ++i) {
    if (shader.has(static_cast<nacre_entry>(i))) present |= 1u << i;
  }
  const std::uint32_t wanted = entries == 0 ? present : present & entries;
  missing_ = present & ~wanted;
  const Binder binder;
  for (const NamedArray& each : arrays) {
    auto use = channel_use(shader, wanted, each.name);
    // Known to the entries that are left out, perhaps.
    if (!use) use = channel_use(shader, present, each.name);
    if (!use) refuse_name(shader, wanted, each.name);
    place(binder.get(), placements_, each.name, each.element, *use, each.object);
  }
  const detail::Said report;
  nacre_binding* made = nullptr;
  report.finish(nacre_binding_create(binder.get(), shader.get(), wanted, report.get(), &made),
                nullptr);
  binding_.reset(made);
  for (int i = 0; i < NACRE_ENTRY_COUNT; ++i) {
    if ((wanted >> i & 1) != 0) find_uses(shader, static_cast<nacre_entry>(i));
  }
}

void BoundArrays::find_uses(const Shader& shader, nacre_entry entry) {
  std::vector<std::string> streamed;
  for (const Channel& each : shader.inputs(entry)) streamed.push_back(each.name);
  for (const Channel& each : shader.results(entry)) streamed.push_back(each.name);
  // What is bound for NACRE_EVALUATE_AT and is neither is read of its one point, whether or not
  // another entry reads it as well; but for what others store.
  std::vector<std::string> stored;
  for (int i = 0; entry == NACRE_EVALUATE_AT && i < NACRE_ENTRY_COUNT; ++i) {
    for (const Channel& each : shader.results(static_cast<nacre_entry>(i))) {
      if (each.role != NACRE_STATE) stored.push_back(each.name);
    }
  }
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const auto is_one_of = [&](const std::vector<std::string>& channels) {
      return std::any_of(channels.begin(), channels.end(), [&](const std::string& channel) {
        return covers(placements_[i].name, channel);
      });
    };
    const bool is_streamed = is_one_of(streamed);
    if (is_streamed) uses_[entry].push_back({i, false});
    if (entry == NACRE_EVALUATE_AT && !is_streamed && !is_one_of(stored)) {
      uses_[entry].push_back({i, true});
    }
  }
}

std::uint64_t BoundArrays::count(nacre_entry entry) const {
  std::uint64_t least = Placement::endless;
  for (const Use& use : uses_[entry]) {
    const Placement& array = placements_[use.array];
    if (use.is_of_one_point || array.element == NACRE_OF_INSTANCE) continue;
    least = std::min(least, array.length);
  }
  return least;
}

std::uint64_t BoundArrays::length() const {
  std::uint64_t least = Placement::endless;
  for (const Placement& array : placements_) {
    if (array.element == NACRE_OF_POINT) least = std::min(least, array.length);
  }
  return least;
}

std::uint64_t BoundArrays::needed(const Use& use, const Request& request, std::uint64_t past_points,
                                  std::uint64_t past_instances) const {
  const int element = placements_[use.array].element;
  if (use.is_of_one_point) {
    return 1 + std::uint64_t{element == NACRE_OF_INSTANCE ? request.instances[request.point]
                                                          : request.point};
  }
  if (element == NACRE_OF_INSTANCE) return past_instances;
  return element == NACRE_OF_PLACE ? request.count : past_points;
}

void BoundArrays::check(nacre_entry entry, const Request& request) const {
  if ((missing_ >> entry & 1) != 0) {
    refuse("unbound-entry", "entry", "the arrays were bound for other entries",
           "one of those that bind() was asked for", std::to_string(entry));
  }
  const std::uint64_t past_points =
      request.points != nullptr ? past(request.points, request.count) : request.count;
  const auto& uses = uses_[entry];
  std::uint64_t listed = 0;  // Elements that the list of instances must have.
  bool is_of_points = false;
  for (const Use& use : uses) {
    if (placements_[use.array].element != NACRE_OF_INSTANCE) continue;
    is_of_points = is_of_points || !use.is_of_one_point;
    listed = std::max(listed, use.is_of_one_point ? std::uint64_t{request.point} + 1 : past_points);
  }
  if (request.instance_count < listed) refuse_length("instances", listed, request.instance_count);
  const std::uint64_t past_instances = is_of_points ? past_instances_of(request) : 0;
  for (const Use& use : uses) {
    const std::uint64_t least = needed(use, request, past_points, past_instances);
    const Placement& array = placements_[use.array];
    if (array.length < least) refuse_length(array.name, least, array.length);
  }
}

bool BoundArrays::run(nacre_entry entry, const Request& request) const {
  std::vector<void*> arrays;
  for (const Placement& each : placements_) arrays.push_back(each.data);
  nacre_batch batch{};
  batch.size = sizeof batch;
  batch.array_count = arrays.size();
  batch.instances = request.instances;
  batch.stop = request.stop;
  batch.point = request.point;
  nacre_status status = NACRE_OK;
  for (std::uint64_t first = 0; first < request.count && status == NACRE_OK; first += interval) {
    if (first > 0 && PyErr_CheckSignals() != 0) nb::raise_python_error();
    for (const Use& use : uses_[entry]) {
      const Placement& array = placements_[use.array];
      const bool moves =
          !use.is_of_one_point && (array.element == NACRE_OF_PLACE ||
                                   (array.element == NACRE_OF_POINT && request.points == nullptr));
      if (moves) arrays[use.array] = array.data + array.stride * static_cast<std::ptrdiff_t>(first);
    }
    batch.arrays = arrays.data();
    batch.count = std::min(interval, request.count - first);
    if (request.points != nullptr) batch.points = request.points + first;
    const bool counts_on = request.points == nullptr && request.instances != nullptr;
    if (counts_on && entry != NACRE_EVALUATE_AT) batch.instances = request.instances + first;
    const nb::gil_scoped_release others_run;
    status = nacre_run(binding_.get(), entry, request.instance, &batch);
  }
  if (status == NACRE_STOPPED) return false;
  if (status == NACRE_TOO_MANY_STEPS) {
    refuse("too-many-steps", "entry", "a loop of the shader does not end", "", "");
  }
  detail::check(status);
  return true;
}

}  // namespace nacre::python
