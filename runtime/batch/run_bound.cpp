#include "runtime/batch/run_bound.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "runtime/batch/index_runs.h"
#include "runtime/batch/room.h"
#include "runtime/batch/words.h"

namespace nacre {

namespace {

/// Words of all copies at once: within a level-2 cache. What a kernel computes once a call it
/// computes once for so many points, and of a live material that is as much as for 20 of them.
constexpr std::size_t staged_words = 32768;
/// Words of copies that need no memory from the heap.
constexpr std::size_t usual_words = 4096;
/// Channels that need no memory from the heap.
constexpr std::size_t usual_channels = 96;

/// Collects what a list picks, until there is enough to be copied together.
template <class Make>
class Copies {
 public:
  /// make(list, copies)
  explicit Copies(Make make) : make_(std::move(make)) {}
  void add(IndexRuns& list, const IndexRuns::Copy& copy) {
    if (count_ == IndexRuns::together || (count_ > 0 && list_ != &list)) flush();
    list_ = &list;
    pending_[count_++] = copy;
  }
  void flush() {
    if (count_ > 0) make_(*list_, std::span<const IndexRuns::Copy>(pending_.data(), count_));
    count_ = 0;
  }

 private:
  Make make_;
  IndexRuns* list_ = nullptr;
  std::array<IndexRuns::Copy, IndexRuns::together> pending_;
  std::size_t count_ = 0;
};

/// How the arrays of a batch are read and written.
class Access {
 public:
  Access(const Binding& binding, const Batch& batch) : binding_(binding), batch_(batch) {}

  bool is_listed(const ChannelLayout& layout) const {
    return nacre::is_listed(layout, batch_.points != nullptr);
  }
  bool needs_copy(const ChannelLayout& layout) const {
    return nacre::needs_copy(layout, batch_.points != nullptr);
  }
  /// Element `i` of a channel that no list picks from.
  std::byte* element(const ChannelLayout& layout, std::uint64_t i) const {
    const void* array =
        layout.array == bound_constants ? binding_.constants.data() : batch_.arrays[layout.array];
    return static_cast<std::byte*>(const_cast<void*>(array)) + layout.offset +
           layout.stride * static_cast<std::ptrdiff_t>(i);
  }
  const Binding& binding() const { return binding_; }
  const Batch& batch() const { return batch_; }

 private:
  const Binding& binding_;
  const Batch& batch_;
};

/// The points of a batch, a block at a time: copied, run and written back.
class Stage {
 public:
  /// `rows` has room for a pointer a channel, `words` for `copies` blocks.
  Stage(const Access& access, std::size_t block, void** rows, std::uint32_t* words)
      : access_(access), block_(block), rows_(rows) {
    const auto place = [&](const ChannelLayout& layout, void*& row) {
      if (!access_.needs_copy(layout)) return;
      row = words;
      words += block_ + IndexRuns::slack;
    };
    for (std::size_t k = 0; k < inputs().size(); ++k) {
      const ChannelLayout& input = inputs()[k];
      if (has_copy_before(k)) {
        rows[k] = rows[access_.binding().first_alike[k]];
        continue;
      }
      place(input, rows[k]);
      if (input.stride == 0) fill(input, static_cast<std::uint32_t*>(rows[k]));
      note_lists(input);
    }
    rows += inputs().size();
    outputs_ = rows;
    for (const ChannelLayout& output : outputs()) {
      place(output, *rows++);
      note_lists(output);
    }
  }

  RunStatus run(const RunArrays& run) {
    const std::uint64_t all = access_.batch().count;
    for (std::uint64_t first = 0; first < all; first += block_) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(block_, all - first));
      read(first, count);
      const RunStatus status = run(rows_, outputs_, count);
      if (status != RunStatus::done) return status;
      write(first, count);
    }
    return RunStatus::done;
  }

 private:
  const std::vector<ChannelLayout>& inputs() const { return access_.binding().inputs; }
  const std::vector<ChannelLayout>& outputs() const { return access_.binding().outputs; }

  /// Whether an input before that one has the copy that it needs.
  bool has_copy_before(std::size_t input) const {
    return access_.binding().first_alike[input] != input && access_.needs_copy(inputs()[input]);
  }

  void fill(const ChannelLayout& layout, std::uint32_t* to) const {
    std::uint32_t value = 0;
    std::memcpy(&value, access_.element(layout, 0), sizeof value);
    std::fill_n(to, std::min<std::uint64_t>(block_, access_.batch().count), value);
  }

  void note_lists(const ChannelLayout& layout) {
    if (layout.stride == 0 || layout.array == discarded || !access_.is_listed(layout)) return;
    (layout.element == ElementOf::instance ? uses_instances_ : uses_points_) = true;
  }

  IndexRuns& list_of(const ChannelLayout& layout) {
    return layout.element == ElementOf::instance ? instances_ : points_;
  }

  void prepare_lists(std::uint64_t first, std::size_t count) {
    const Batch& batch = access_.batch();
    if (uses_points_) points_.prepare(batch.points + first, count);
    if (!uses_instances_) return;
    std::array<std::uint32_t, IndexRuns::most> picked;
    for (std::size_t i = 0; i < count; ++i) {
      picked[i] = batch.instances[batch.points != nullptr ? batch.points[first + i] : first + i];
    }
    instances_.prepare(picked.data(), count);
  }

  void read(std::uint64_t first, std::size_t count) {
    prepare_lists(first, count);
    Copies picked([](IndexRuns& list, auto copies) { list.gather(copies); });
    for (std::size_t k = 0; k < inputs().size(); ++k) {
      const ChannelLayout& input = inputs()[k];
      auto* const to = static_cast<std::uint32_t*>(rows_[k]);
      if (input.stride == 0 || has_copy_before(k)) {
        // Filled in for good, or with that.
      } else if (!access_.needs_copy(input)) {
        rows_[k] = access_.element(input, first);
      } else if (access_.is_listed(input)) {
        picked.add(list_of(input), {access_.element(input, 0), input.stride, to});
      } else {
        const std::byte* from = access_.element(input, first);
        gather_words(count, to, [&](std::size_t i) {
          return from + input.stride * static_cast<std::ptrdiff_t>(i);
        });
      }
    }
    picked.flush();
    void** row = outputs_;
    for (const ChannelLayout& output : outputs()) {
      if (!access_.needs_copy(output)) *row = access_.element(output, first);
      ++row;
    }
  }

  void write(std::uint64_t first, std::size_t count) {
    Copies picked([](IndexRuns& list, auto copies) { list.scatter(copies); });
    void* const* row = outputs_;
    for (const ChannelLayout& output : outputs()) {
      auto* const from = static_cast<std::uint32_t*>(*row++);
      if (output.array == discarded || !access_.needs_copy(output)) continue;
      if (access_.is_listed(output)) {
        picked.add(list_of(output), {access_.element(output, 0), output.stride, from});
        continue;
      }
      std::byte* to = access_.element(output, first);
      scatter_words(count, from, [&](std::size_t i) {
        return to + output.stride * static_cast<std::ptrdiff_t>(i);
      });
    }
    picked.flush();
  }

  const Access access_;
  std::size_t block_;
  void** rows_;     ///< Of the inputs; those of the outputs follow.
  void** outputs_;  ///< Their rows.
  bool uses_points_ = false;
  bool uses_instances_ = false;
  IndexRuns points_;
  IndexRuns instances_;
};

bool fits(const Binding& binding, const Batch& batch) {
  return batch.arrays.size() >= binding.arrays &&
         (batch.arrays.data() != nullptr || batch.arrays.empty()) &&
         (batch.instances != nullptr || !binding.reads_instances);
}

}  // namespace

RunStatus run_bound(const Binding& binding, const Batch& batch, const RunArrays& run) {
  if (!fits(binding, batch)) return RunStatus::wrong_arguments;
  const Access access(binding, batch);
  const std::size_t copies = batch.points != nullptr ? binding.copies_of_list : binding.copies;
  Room<void*, usual_channels> rows(binding.inputs.size() + binding.outputs.size());
  if (copies == 0) {
    void** row = rows.data();
    for (const ChannelLayout& input : binding.inputs) *row++ = access.element(input, 0);
    void** const outputs = row;
    for (const ChannelLayout& output : binding.outputs) *row++ = access.element(output, 0);
    return run(rows.data(), outputs, batch.count);
  }
  const std::size_t block = std::min<std::uint64_t>(
      std::clamp<std::size_t>(staged_words / copies / 16 * 16, 64, IndexRuns::most), batch.count);
  Room<std::uint32_t, usual_words> words(copies * (block + IndexRuns::slack));
  return Stage(access, block, rows.data(), words.data()).run(run);
}

}  // namespace nacre
