#include "jit/passes/contract.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/flatten.h"
#include "jit/passes/structure.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// A product that reaches operand `side` of a sum, perhaps through a neg.
struct Term {
  ValueId product = no_value;
  std::size_t side = 0;
  bool negated = false;
};

/// What becomes of one sum: (-)a b (-) other, where a b is `product`.
struct Fusion {
  const Instruction* product;
  std::size_t other;  ///< Operand of the sum that is added.
  bool negate_product;
  bool negate_other;
};
using Fusions = std::unordered_map<const Instruction*, Fusion>;

/// Chooses the fusions of one function: the same ones in whatever order it was recorded.
class Chooser {
 public:
  Chooser(const Function& function, const Structure& structure)
      : function_(function),
        structure_(structure),
        uses_(function.code.size(), 0),
        sums_(function.code.size(), 0),
        stays_(function.code.size(), false) {}

  void run(Fusions& fusions) {
    count();
    std::vector<ValueId> all;
    for (std::size_t i = 0; i < function_.code.size(); ++i) {
      if (is_sum(static_cast<ValueId>(i))) all.push_back(static_cast<ValueId>(i));
    }
    std::ranges::sort(all, {}, [&](ValueId id) {
      return std::tuple(structure_.depth[id], structure_.digest[id], id);
    });
    std::vector<std::pair<ValueId, Term>> chosen;
    for (const ValueId sum : all) {
      if (const std::optional<Term> term = choose(sum)) chosen.emplace_back(sum, *term);
    }
    for (const auto& [sum, term] : chosen) {
      // It may have lost to another product in a later sum.
      if (vanishes(term.product)) fusions.emplace(&function_.code[sum], fusion(sum, term));
    }
  }

 private:
  bool is_sum(ValueId id) const {
    const Op op = function_.code[id].op;
    return op == Op::add || op == Op::sub;
  }

  /// The products that sum `id` could fuse; none where both operands are the same.
  std::array<Term, 2> terms(ValueId id) const {
    std::array<Term, 2> found;
    const Instruction& sum = function_.code[id];
    if (sum.operands[0] == sum.operands[1]) return found;
    for (std::size_t side = 0; side < 2; ++side) {
      ValueId operand = sum.operands[side];
      const bool negated = function_.code[operand].op == Op::neg && uses_[operand] == 1;
      if (negated) operand = function_.code[operand].operands[0];
      const Instruction& product = function_.code[operand];
      const bool same_rate = product.varying || !sum.varying;
      if (product.op == Op::mul && same_rate) found[side] = {operand, side, negated};
    }
    if (found[0].product == found[1].product) return {};
    return found;
  }

  void count() {
    for (const Instruction& instruction : function_.code) {
      for (const ValueId operand : function_.operands(instruction)) ++uses_[operand];
    }
    for (std::size_t i = 0; i < function_.code.size(); ++i) {
      if (!is_sum(static_cast<ValueId>(i))) continue;
      for (const Term& term : terms(static_cast<ValueId>(i))) {
        if (term.product != no_value) ++sums_[term.product];
      }
    }
  }

  /// All that uses the product are sums that will fuse it.
  bool vanishes(ValueId product) const {
    return !stays_[product] && sums_[product] == uses_[product];
  }

  std::optional<Term> choose(ValueId id) {
    auto [best, other] = terms(id);
    const auto possible = [&](const Term& t) {
      return t.product != no_value && vanishes(t.product);
    };
    if (!possible(best)) std::swap(best, other);
    if (!possible(best)) return std::nullopt;
    if (!possible(other)) return best;
    const auto key = [&](const Term& t) {
      return std::tuple(uses_[t.product], ~structure_.depth[t.product],
                        structure_.digest[t.product], t.product);
    };
    if (key(other) < key(best)) std::swap(best, other);
    stays_[other.product] = true;
    return best;
  }

  Fusion fusion(ValueId id, const Term& term) const {
    const bool minus = function_.code[id].op == Op::sub;
    return {.product = &function_.code[term.product],
            .other = 1 - term.side,
            .negate_product = term.negated != (minus && term.side == 1),
            .negate_other = minus && term.side == 0};
  }

  const Function& function_;
  const Structure& structure_;
  std::vector<std::uint32_t> uses_;
  std::vector<std::uint32_t> sums_;  ///< Of the uses, those that could fuse the product.
  std::vector<bool> stays_;          ///< Products that lost.
};

bool is_neg(Ref x, const std::unordered_map<ValueId, Ref>& negs) {
  return !x.is_constant() && negs.contains(x.id);
}

/// Records the fusions; remembers what products and negs were made of.
class Fuser {
 public:
  Fuser(const Program& program, const Fusions& fusions) : program_(program), fusions_(fusions) {}

  std::optional<Ref> operator()(Recorder& recorder, const Instruction& instruction,
                                std::span<const Ref> operands) {
    enter(instruction);
    if (instruction.op == Op::mul) products_[&instruction] = {operands[0], operands[1]};
    if (instruction.op == Op::neg) return remember(recorder, operands[0]);
    const auto found = fusions_.find(&instruction);
    if (found == fusions_.end()) return std::nullopt;
    const Fusion& fusion = found->second;
    auto [a, b] = products_.at(fusion.product);
    Ref c = operands[fusion.other];
    if (fusion.negate_product) std::tie(a, b) = negate_one(recorder, a, b);
    if (fusion.negate_other) c = negate(recorder, c);
    const std::array<Ref, 3> parts{a, b, c};
    return recorder.emit(Op::fma, parts);
  }

 private:
  /// Values are named within their function: another one, other names.
  void enter(const Instruction& instruction) {
    const auto holds = [&](const Function& f) {
      return !f.code.empty() && &instruction >= f.code.data() &&
             &instruction < f.code.data() + f.code.size();
    };
    if (function_ != nullptr && holds(*function_)) return;
    function_ = &*std::ranges::find_if(program_.functions, holds);
    negs_.clear();
  }

  Ref remember(Recorder& recorder, Ref x) {
    const Ref result = recorder.emit(Op::neg, std::span(&x, 1));
    if (!result.is_constant()) negs_.insert_or_assign(result.id, x);
    return result;
  }

  Ref negate(Recorder& recorder, Ref x) {
    return is_neg(x, negs_) ? negs_.at(x.id) : remember(recorder, x);
  }

  /// -(a b), the sign put where it is free if it can be.
  std::pair<Ref, Ref> negate_one(Recorder& recorder, Ref a, Ref b) {
    const bool free = b.is_constant() || is_neg(b, negs_);
    if (free && !a.is_constant() && !is_neg(a, negs_)) return {a, negate(recorder, b)};
    return {negate(recorder, a), b};
  }

  const Program& program_;
  const Fusions& fusions_;
  const Function* function_ = nullptr;
  std::unordered_map<const Instruction*, std::pair<Ref, Ref>> products_;
  std::unordered_map<ValueId, Ref> negs_;
};

}  // namespace

namespace {

Fusions choose(const Program& marked) {
  Fusions fusions;
  const std::vector<Structure> structures = structures_of(marked);
  for (std::size_t i = 0; i < marked.functions.size(); ++i) {
    Chooser(marked.functions[i], structures[i]).run(fusions);
  }
  return fusions;
}

}  // namespace

Program contract(const Program& program, bool flattens) {
  constexpr std::size_t any = std::size_t{1} << 31;
  // Whether two factors are fused is not to hang on who calls a function.
  const auto marked = [](Program made) {
    mark_varying(made, false, true);
    return made;
  };
  const Program before = marked(program);
  Fusions fusions = choose(before);
  if (fusions.empty() && !flattens) return before;
  Program result = marked(transform(before, Fuser(before, fusions), any,
                                    flattens ? cheap_regions(before) : Flattening()));
  // A product that stayed may be free to go once its rival is gone; every
  // round has fewer sums.
  for (fusions = choose(result); !fusions.empty(); fusions = choose(result)) {
    result = marked(transform(result, Fuser(result, fusions)));
  }
  return result;
}

}  // namespace nacre
