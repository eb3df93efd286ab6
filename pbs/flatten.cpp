#include <optional>
#include <string>
#include <unordered_map>

#include "pbs/bsdf.h"
#include "runtime/program/origin.h"

namespace nacre {

namespace {

/// Goes from a node to its parts once all its readers have said how much they see of it.
/// In a tree that is depth first; what is shared waits for its last reader, so that n
/// nodes take n steps and not one for each way that leads to them.
class Flattener {
 public:
  Flattener(const View& view, const std::function<bool()>& may_go_on)
      : view_(view),
        may_go_on_(may_go_on),
        passes_([this](const BsdfPtr& bsdf) { return throughput(bsdf.get()); }) {}

  std::vector<WeightedLobe> run(const Bsdf& root) {
    count_readers(root);
    states_.at(&root).readers = 1;
    see(&root, {.weight = Color3(1.0f)});
    while (!open_.empty() && !ended_) {
      Open& at = open_.back();
      if (at.part == Bsdf::Parts::count) {
        open_.pop_back();
        continue;
      }
      if (at.part == 1 && !is_zero(states_.at(at.bsdf).seen.weight)) {
        at.bsdf->report(view_, states_.at(at.bsdf).seen.weight);
      }
      const std::size_t i = at.part++;
      const Bsdf* part = at.bsdf->parts()[i].get();
      if (part == nullptr) continue;
      see(part, seen_of(*at.bsdf, i));
    }
    return std::move(lobes_);
  }

 private:
  /// Of a node.
  struct Seen {
    Color3 weight = Color3(0.0f);
    /// Something asks what it lets pass.
    bool is_asked = false;
    /// The weight with which that counts, if it is not the other: what a tint turns black takes as
    /// much away from a layer underneath.
    std::optional<Color3> shade = {};
  };
  struct State {
    std::size_t readers = 0;  ///< That have not yet said what they see of it.
    Seen seen;
    std::optional<Color3> throughput;
  };
  struct Open {
    const Bsdf* bsdf;
    std::size_t part = 0;
  };

  void count_readers(const Bsdf& root) {
    std::vector<const Bsdf*> found{&root};
    states_.try_emplace(&root);
    while (!found.empty()) {
      const Bsdf* bsdf = found.back();
      found.pop_back();
      for (std::size_t i = 0; i < Bsdf::Parts::count; ++i) {
        const Bsdf* part = bsdf->parts()[i].get();
        if (part == nullptr) continue;
        const auto [place, is_new] = states_.try_emplace(part);
        ++place->second.readers;
        if (is_new) found.push_back(part);
      }
    }
  }

  /// What a node that is seen itself shows of a part.
  Seen seen_of(const Bsdf& bsdf, std::size_t i) {
    const Seen seen = states_.at(&bsdf).seen;
    // What is not seen at all still has to say so to its parts.
    if (is_zero(seen.weight)) return {.weight = seen.weight};
    Seen part{.weight = bsdf.part_weight(i, seen.weight, passes_),
              .is_asked = bsdf.asks(i) || (seen.is_asked && bsdf.shades(i))};
    if (!part.is_asked) return part;
    if (bsdf.blackens()) {
      part.shade = seen.shade.value_or(seen.weight);
    } else if (seen.shade) {
      part.shade = bsdf.part_weight(i, *seen.shade, passes_);
    }
    return part;
  }

  /// One reader of `bsdf` sees that of it.
  void see(const Bsdf* bsdf, const Seen& seen) {
    State& state = states_.at(bsdf);
    state.seen = sum(state.seen, seen);
    if (--state.readers > 0) return;
    const LobeBsdf* leaf = bsdf->leaf();
    if (leaf == nullptr) {
      open_.push_back({bsdf});
    } else {
      add(*leaf, state.seen);
    }
  }

  static Color3 sum(Color3 a, Color3 b) { return is_zero(a) ? b : is_zero(b) ? a : a + b; }
  static Seen sum(const Seen& a, const Seen& b) {
    Seen both{.weight = sum(a.weight, b.weight), .is_asked = a.is_asked || b.is_asked};
    if (!a.shade && !b.shade) return both;
    both.shade = sum(a.shade.value_or(a.weight), b.shade.value_or(b.weight));
    return both;
  }

  void add(const LobeBsdf& leaf, const Seen& seen) {
    const Color3 total = product(seen.weight, Color3(leaf.weight()));
    if (is_zero(total)) return note_unseen(leaf);
    ended_ = may_go_on_ && !may_go_on_();
    if (ended_) return;
    leaf.report(view_, total);
    const ScopedOrigin origin(*view_.recorder, leaf.origin());
    const Color3 counts = seen.shade ? product(*seen.shade, Color3(leaf.weight())) : total;
    leaf.lobe()->prepare(view_, max_component(counts) > 0.0f);
    lobes_.push_back({leaf.lobe(), total, leaf.origin()});
  }

  void note_unseen(const LobeBsdf& leaf) const {
    if (view_.unseen == nullptr) return;
    const std::string& path = view_.recorder->program().origins[leaf.origin()];
    view_.unseen->add(std::string(leaf.lobe()->name()) + " at " + path + ": weight 0");
  }

  /// Of the parts first, without recursion; each node is asked once.
  Color3 throughput(const Bsdf* root) {
    if (root == nullptr) return Color3(1.0f);
    std::vector<const Bsdf*> wanted{root};
    while (!wanted.empty()) {
      const Bsdf* bsdf = wanted.back();
      State& state = states_.at(bsdf);
      if (state.throughput) {
        wanted.pop_back();
        continue;
      }
      Color3 of_part[2] = {Color3(1.0f), Color3(1.0f)};
      bool waits = false;
      for (std::size_t i = 0; i < Bsdf::Parts::count; ++i) {
        if (!bsdf->shades(i)) continue;
        const Bsdf* part = bsdf->parts()[i].get();
        const std::optional<Color3>& known = states_.at(part).throughput;
        if (known) {
          of_part[i] = *known;
        } else {
          wanted.push_back(part);
          waits = true;
        }
      }
      if (waits) continue;
      // A lobe that has readers to come: in which lanes it counts is not known yet.
      const LobeBsdf* leaf = bsdf->leaf();
      const ScopedOrigin origin(*view_.recorder,
                                leaf == nullptr ? view_.recorder->origin() : leaf->origin());
      if (state.readers > 0 && leaf != nullptr && !leaf->lobe()->is_opaque()) {
        leaf->lobe()->prepare(view_, Bool(true));
      }
      state.throughput = bsdf->throughput(view_, of_part[0], of_part[1]);
      wanted.pop_back();
    }
    return *states_.at(root).throughput;
  }

  const View& view_;
  const std::function<bool()>& may_go_on_;
  const Throughput passes_;
  std::unordered_map<const Bsdf*, State> states_;
  std::vector<Open> open_;
  std::vector<WeightedLobe> lobes_;
  bool ended_ = false;
};

}  // namespace

std::vector<WeightedLobe> flatten(const BsdfPtr& bsdf, const View& view,
                                  const std::function<bool()>& may_go_on) {
  if (bsdf == nullptr) return {};
  return Flattener(view, may_go_on).run(*bsdf);
}

}  // namespace nacre
