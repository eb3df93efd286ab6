#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pbs/closure_parts.h"
#include "pbs/lobe.h"
#include "pbs/vdf.h"
#include "runtime/node/recorded.h"

namespace nacre {

class Bsdf;
class LobeBsdf;
class NodeCall;
using BsdfPtr = std::shared_ptr<const Bsdf>;  ///< Null: nothing is connected.

/// A lobe with everything that stands above it multiplied out, for one view.
struct WeightedLobe {
  LobePtr lobe;              ///< Never null.
  Color3 weight;             ///< Factor of all that the lobe gives; never all literal zeros.
  std::uint32_t origin = 0;  ///< The node that it is of, by Recorder::origin().
};

/// What a BSDF lets pass, as `flatten` has found out; 1 where nothing is connected.
using Throughput = std::function<Color3(const BsdfPtr&)>;

/// A node of a BSDF. Nodes are shared: what is used twice is one node with two readers.
/// They exist while recording only: kernels contain the flat sum of weighted lobes that
/// `flatten` makes of them.
class Bsdf : public Closure {
 public:
  /// Up to two closures that it is made of.
  using Parts = ClosureParts<Bsdf>;
  /// Null for a part that is not there.
  explicit Bsdf(BsdfPtr first = nullptr, BsdfPtr second = nullptr)
      : parts_(std::move(first), std::move(second)) {}
  /// Each may be null.
  const Parts& parts() const { return parts_; }

  /// Itself if it is a leaf, or null.
  virtual const LobeBsdf* leaf() const { return nullptr; }
  /// The weight of part `i` where the whole has `weight`. What stands before part `i` has
  /// been flattened, so that `passes` may be asked about it.
  virtual Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const = 0;
  /// Whether it may turn a part black that lets as little pass as before.
  virtual bool blackens() const { return false; }
  /// Whether part_weight() asks what part `i` lets pass.
  virtual bool asks(std::size_t i) const { return (void)i, false; }
  /// Whether part `i` has to do with what the whole lets pass.
  virtual bool shades(std::size_t i) const { return parts_[i] != nullptr; }
  /// What passes through to a layer underneath, in [0, 1], by what the parts let pass: 1
  /// for those that have nothing to do with it.
  virtual Color3 throughput(const View& view, Color3 first, Color3 second) const = 0;
  /// The same of other parts; null for a leaf, which has none.
  virtual BsdfPtr with_parts(BsdfPtr first, BsdfPtr second) const {
    return (void)first, (void)second, nullptr;
  }
  /// Whether nothing else of this node lies on part `i`.
  virtual bool is_uppermost(std::size_t i) const { return (void)i, true; }
  /// Adds to view.left_out and view.media, where they are not null, what of this node the kernels
  /// of what scatters leave out; `weight` of the node is seen.
  virtual void report(const View& view, Color3 weight) const { (void)view, (void)weight; }

 private:
  Parts parts_;
};

/// A leaf: a lobe times a scalar weight in [0, 1], or more where the graph says so.
class LobeBsdf final : public Bsdf {
 public:
  /// `is_nothing`: as set_lobe.
  LobeBsdf(LobePtr lobe, Float weight, std::uint32_t origin = 0, bool is_nothing = false)
      : lobe_(std::move(lobe)), weight_(weight), origin_(origin), is_nothing_(is_nothing) {}
  /// Never null.
  const LobePtr& lobe() const { return lobe_; }
  /// What the node's own input says; 0 where the lobe is nothing.
  Float weight() const { return is_nothing_ ? Float(0.0f) : weight_; }
  /// As in WeightedLobe.
  std::uint32_t origin() const { return origin_; }
  const LobeBsdf* leaf() const override { return this; }
  Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const override;
  Color3 throughput(const View& view, Color3 first, Color3 second) const override;
  /// Another lobe, not null, in its place; it counts where the one before was nothing.
  BsdfPtr with_lobe(LobePtr lobe) const;
  void report(const View& view, Color3 weight) const override;

 private:
  LobePtr lobe_;
  Float weight_;
  std::uint32_t origin_;
  bool is_nothing_;
};

/// Sets a node's output to its lobe, times its input "weight": in [0, 1e6]. `is_nothing`: it
/// scatters nothing and lets all pass, whatever its weight.
void set_lobe(NodeCall& call, LobePtr lobe, bool is_nothing = false);

/// top over base: base is seen through what top lets pass. A medium behind top is the
/// renderer's to trace, and left out.
class LayerBsdf final : public Bsdf {
 public:
  /// Any may be null.
  LayerBsdf(BsdfPtr top, BsdfPtr base, VdfPtr medium = nullptr)
      : Bsdf(std::move(top), std::move(base)), medium_(std::move(medium)) {}
  Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const override;
  Color3 throughput(const View& view, Color3 first, Color3 second) const override;
  BsdfPtr with_parts(BsdfPtr top, BsdfPtr base) const override;
  bool asks(std::size_t i) const override { return i == 0; }
  bool is_uppermost(std::size_t i) const override { return i == 0; }
  void report(const View& view, Color3 weight) const override;

 private:
  VdfPtr medium_;
};

/// fg in proportion mix, bg in proportion 1 - mix.
class MixBsdf final : public Bsdf {
 public:
  /// Either may be null; `mix` in [0, 1].
  MixBsdf(BsdfPtr fg, BsdfPtr bg, Float mix) : Bsdf(std::move(fg), std::move(bg)), mix_(mix) {}
  Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const override;
  bool shades(std::size_t i) const override;
  Color3 throughput(const View& view, Color3 first, Color3 second) const override;
  BsdfPtr with_parts(BsdfPtr fg, BsdfPtr bg) const override;

 private:
  Float mix_;
};

/// Both in one place: the weights stay, what they take from a layer underneath adds up.
class AddBsdf final : public Bsdf {
 public:
  /// Either may be null.
  AddBsdf(BsdfPtr in1, BsdfPtr in2) : Bsdf(std::move(in1), std::move(in2)) {}
  Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const override;
  Color3 throughput(const View& view, Color3 first, Color3 second) const override;
  BsdfPtr with_parts(BsdfPtr in1, BsdfPtr in2) const override;
};

/// in1 with its weight tinted. What it lets pass stays as it is.
class MultiplyBsdf final : public Bsdf {
 public:
  /// `tint` in [0, 1].
  MultiplyBsdf(BsdfPtr in1, Color3 tint) : Bsdf(std::move(in1)), tint_(tint) {}
  Color3 part_weight(std::size_t i, Color3 weight, const Throughput& passes) const override;
  bool blackens() const override;
  Color3 throughput(const View& view, Color3 first, Color3 second) const override;
  BsdfPtr with_parts(BsdfPtr in1, BsdfPtr none) const override;

 private:
  Color3 tint_;
};

/// The lobes that `bsdf` consists of, each once, in the order in which they are met from
/// the top down, first parts first. Lobes and branches whose weight is a literal zero are
/// left out. `may_go_on` is asked before each lobe; where it says no, that is the end.
std::vector<WeightedLobe> flatten(const BsdfPtr& bsdf, const View& view,
                                  const std::function<bool()>& may_go_on = {});

/// The Bsdf that a port carries; null where nothing is connected.
BsdfPtr as_bsdf(const ClosurePtr& closure);

}  // namespace nacre
