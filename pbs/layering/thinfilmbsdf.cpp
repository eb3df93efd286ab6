#include <unordered_map>

#include "pbs/bsdf.h"
#include "pbs/facets.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// A base that no film holds on to.
class BareBsdf final : public Bsdf {
 public:
  explicit BareBsdf(BsdfPtr base) : Bsdf(std::move(base)) {}
  Color3 part_weight(std::size_t, Color3 weight, const Throughput&) const override {
    return weight;
  }
  Color3 throughput(const View&, Color3 base, Color3) const override { return base; }
  BsdfPtr with_parts(BsdfPtr base, BsdfPtr) const override {
    return std::make_shared<BareBsdf>(std::move(base));
  }
  void report(const View& view, Color3) const override {
    if (view.left_out == nullptr) return;
    view.left_out->add("thinfilmbsdf: no lobe of its base has facets for a film");
  }
};

/// The closures of a base with a film on the facets that are uppermost.
class FilmOver {
 public:
  FilmOver(Recorder& recorder, const ThinFilm& film) : recorder_(recorder), film_(film) {}

  /// Of the parts first, without recursion; what is shared is made once.
  BsdfPtr run(const BsdfPtr& base) {
    std::vector<BsdfPtr> wanted{base};
    while (!wanted.empty()) {
      const BsdfPtr bsdf = wanted.back();
      const std::size_t before = wanted.size();
      for (std::size_t i = 0; i < Bsdf::Parts::count; ++i) {
        const BsdfPtr& part = bsdf->parts()[i];
        if (is_reached(*bsdf, i) && !made_.contains(part.get())) wanted.push_back(part);
      }
      if (wanted.size() > before) continue;
      wanted.pop_back();
      made_.try_emplace(bsdf.get(), make(*bsdf, bsdf));
    }
    return found_ ? made_.at(base.get()) : std::make_shared<BareBsdf>(base);
  }

 private:
  static bool is_reached(const Bsdf& bsdf, std::size_t i) {
    return bsdf.parts()[i] != nullptr && bsdf.is_uppermost(i);
  }

  BsdfPtr make(const Bsdf& bsdf, const BsdfPtr& itself) {
    if (const LobeBsdf* leaf = bsdf.leaf()) {
      const LobePtr lobe = leaf->lobe()->with_film(recorder_, film_);
      found_ = found_ || lobe != nullptr;
      return lobe == nullptr ? itself : leaf->with_lobe(lobe);
    }
    const auto part = [&](std::size_t i) {
      return is_reached(bsdf, i) ? made_.at(bsdf.parts()[i].get()) : bsdf.parts()[i];
    };
    return bsdf.with_parts(part(0), part(1));
  }

  Recorder& recorder_;
  const ThinFilm& film_;
  std::unordered_map<const Bsdf*, BsdfPtr> made_;
  bool found_ = false;
};

}  // namespace

/// thinfilmbsdf: a film on the facets of a base, on the uppermost ones of layers. ShaderX, 2018,
/// "BSDF Nodes". MaterialX of today gives the film to the closure that has the facets.
void record_closure_thinfilmbsdf(NodeCall& call) {
  const BsdfPtr base = as_bsdf(call.closure("base"));
  ThinFilm film(call.number("thickness"), call.number("ior"), call.accuracy());
  if (base == nullptr || !film.exists()) return call.set(base);
  visit(film, [&](Float& x) { x = keep(call.recorder(), x); });
  call.set(FilmOver(call.recorder(), film).run(base));
}

}  // namespace nacre
