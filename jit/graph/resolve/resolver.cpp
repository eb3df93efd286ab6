#include "jit/graph/resolve/resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "runtime/report_stop.h"

namespace nacre {

namespace {

/// Of names and values, on average, where max_nodes are used up.
constexpr double bytes_of_node = 1024;

}  // namespace

std::size_t Resolver::bytes_of(const Source& source) {
  std::size_t bytes = source.colorspace.size() + source.document.size();
  bytes += 4 * (source.value.floats.size() + source.value.ints.size());
  for (const std::string& text : source.value.texts) bytes += text.size();
  return bytes;
}

std::size_t Resolver::KeyHash::operator()(const Key& key) const {
  const std::hash<const void*> hash;
  const std::size_t a = hash(key.subject);
  const std::size_t b = hash(key.context) * 0x9E3779B97F4A7C15u;
  return a ^ (b >> 7) ^ (std::size_t{key.index} << 3) ^ static_cast<std::size_t>(key.kind);
}

Resolved Resolver::run(Key key) {
  if (const auto known = slots_.find(key); known != slots_.end()) return known->second.result;
  std::deque<Task> stack;
  const auto open = [&](Slots::value_type& wanted) {
    Slot& slot = wanted.second;
    stack.push_back({wanted.first, &slot, slot.result, Stage::start, 0, nullptr});
  };
  Slots::value_type& first = *slots_.try_emplace(key).first;
  open(first);
  while (!stack.empty()) {
    Task& task = stack.back();
    // Graphs within graphs may double at each level: stop at once.
    if (is_too_large(task) || is_due(task)) {
      for (const Task& open_task : stack) *open_task.slot = {true, failure()};
      return failure();
    }
    const std::optional<Key> wanted = step(task);
    if (!wanted) {
      bytes_ += bytes_of(task.result.source);
      task.slot->done = true;
      stack.pop_back();
      continue;
    }
    const auto [waited, is_new] = slots_.try_emplace(*wanted);
    task.waiting_for = &*waited;
    if (is_new) {
      open(*waited);
    } else if (!waited->second.done) {
      // In a cycle each waits for the next; whoever closes it fails, and the
      // failure travels back along the stack.
      report_cycle(stack, *wanted);
      task.result.failed = true;
      task.slot->done = true;
      stack.pop_back();
    }
  }
  return first.second.result;
}

Resolved Resolver::failure() {
  Resolved result;
  result.failed = true;
  return result;
}

// Each node has an instance, and so has each that a graph stands for: a document may consist of
// nothing but graphs of graphs.
double Resolver::fullness() const {
  const auto limit = static_cast<double>(options_.max_nodes);
  return std::max(static_cast<double>(instances_.count()) / limit,
                  static_cast<double>(bytes_ + instances_.bytes()) / (bytes_of_node * limit));
}

bool Resolver::is_too_large(const Task& task) {
  if (fullness() <= 1) return false;
  if (!too_large_) {
    const auto most = static_cast<double>(options_.max_nodes);
    if (static_cast<double>(bytes_ + instances_.bytes()) > bytes_of_node * most) {
      complaints_.error("graph-too-large", where(task),
                        "the names and values in the graph take too much",
                        fmt::format("at most {:.0f} bytes", bytes_of_node * most));
    } else {
      complaints_.error("too-many-nodes", where(task), "the graph has too many nodes",
                        fmt::format("at most {}", options_.max_nodes));
    }
  }
  too_large_ = true;
  return true;
}

bool Resolver::is_due(const Task& task) {
  if (due_) return true;
  if ((++steps_ & 0x3F) != 0 || !options_.stop.is_due()) return false;
  return due_ = report_if_due(options_.stop, "building the graph", location(where(task)),
                              complaints_.diagnostics());
}

const Element& Resolver::where(const Task& task) {
  return task.key.kind == Kind::port ? *static_cast<const Element*>(task.key.subject)
                                     : *static_cast<const Instance*>(task.key.subject)->origin;
}

std::optional<Resolver::Key> Resolver::step(Task& task) {
  switch (task.key.kind) {
    case Kind::node: return step_node(task);
    case Kind::output: return step_output(task);
    case Kind::input: return step_input(task);
    case Kind::port: return step_port(task);
  }
  return std::nullopt;
}

void Resolver::report_cycle(const std::deque<Task>& stack, const Key& again) {
  const auto first =
      std::find_if(stack.begin(), stack.end(), [&](const Task& task) { return task.key == again; });
  std::string path;
  const Element* where = nullptr;
  std::size_t shown = 0;
  std::string last;
  for (auto task = first; task != stack.end(); ++task) {
    std::string name;
    if (task->key.kind == Kind::port) {
      const auto& port = *static_cast<const Element*>(task->key.subject);
      if (where == nullptr) where = &port;
      name = element_path(port);
    } else {
      name = static_cast<const Instance*>(task->key.subject)->path;
    }
    if (name == last) continue;
    last = name;
    if (++shown <= 16) path += (path.empty() ? "" : " <- ") + name;
  }
  if (shown > 16) path += fmt::format(" <- ({} more)", shown - 16);
  if (where == nullptr) where = &document_.root();
  complaints_.error("cycle", *where, "the connections form a cycle", "", path);
}

Resolved Resolver::resolve_port(const Element& port, const Context* context, std::uint32_t leaf) {
  return run({Kind::port, leaf, &port, context});
}

Resolved Resolver::resolve_node(const Element& node, std::string_view output,
                                const Context* context) {
  const Instance* instance = instances_.of(node, context);
  if (instance == nullptr) return failure();
  const auto index = instances_.output_index(*instance->def, output, node);
  return index ? run({Kind::output, *index, instance, nullptr}) : failure();
}

Resolved Resolver::resolve_input(const Element& node, std::uint32_t index, const Context* context) {
  const Instance* instance = instances_.of(node, context);
  return instance != nullptr ? run({Kind::input, index, instance, nullptr}) : failure();
}

}  // namespace nacre
