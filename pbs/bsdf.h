#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pbs/lobe.h"
#include "pbs/vdf.h"
#include "runtime/node/recorded.h"

namespace nacre {

/// A lobe with everything that stands above it multiplied out, for one view.
struct WeightedLobe {
  LobePtr lobe;
  Color3 weight;
};

/// A node of a BSDF tree. Trees exist while recording only: kernels contain the
/// flat sum of weighted lobes that `flatten` makes of one.
class Bsdf : public Closure {
 public:
  /// Appends the lobes below, each times `weight`. A lobe or branch whose
  /// weight is a literal zero is left out.
  virtual void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const = 0;
  /// What passes through to a layer underneath; in [0, 1].
  virtual Color3 throughput(const View& view) const = 0;
};
using BsdfPtr = std::shared_ptr<const Bsdf>;

/// A leaf: a lobe times a scalar weight in [0, 1], or more where the graph says so.
class LobeBsdf final : public Bsdf {
 public:
  /// `left_out` lists what the lobe does not model of its node; see View::left_out.
  LobeBsdf(LobePtr lobe, Float weight, std::vector<std::string> left_out = {})
      : lobe_(std::move(lobe)), weight_(weight), left_out_(std::move(left_out)) {}
  void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const override;
  Color3 throughput(const View& view) const override;

 private:
  LobePtr lobe_;
  Float weight_;
  std::vector<std::string> left_out_;
};

/// top over base: base is seen through what top lets pass. A medium behind top is the
/// renderer's to trace, and left out.
class LayerBsdf final : public Bsdf {
 public:
  LayerBsdf(BsdfPtr top, BsdfPtr base, VdfPtr medium = nullptr)
      : top_(std::move(top)), base_(std::move(base)), medium_(std::move(medium)) {}
  void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const override;
  Color3 throughput(const View& view) const override;

 private:
  BsdfPtr top_, base_;
  VdfPtr medium_;
};

/// fg in proportion mix, bg in proportion 1 - mix.
class MixBsdf final : public Bsdf {
 public:
  MixBsdf(BsdfPtr fg, BsdfPtr bg, Float mix) : fg_(std::move(fg)), bg_(std::move(bg)), mix_(mix) {}
  void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const override;
  Color3 throughput(const View& view) const override;

 private:
  BsdfPtr fg_, bg_;
  Float mix_;
};

class AddBsdf final : public Bsdf {
 public:
  AddBsdf(BsdfPtr in1, BsdfPtr in2) : in1_(std::move(in1)), in2_(std::move(in2)) {}
  void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const override;
  Color3 throughput(const View& view) const override;

 private:
  BsdfPtr in1_, in2_;
};

class MultiplyBsdf final : public Bsdf {
 public:
  MultiplyBsdf(BsdfPtr in1, Color3 tint) : in1_(std::move(in1)), tint_(tint) {}
  void flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const override;
  Color3 throughput(const View& view) const override;

 private:
  BsdfPtr in1_;
  Color3 tint_;
};

/// The Bsdf that a port carries; null where nothing is connected.
BsdfPtr as_bsdf(const ClosurePtr& closure);

}  // namespace nacre
