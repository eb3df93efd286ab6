#include "jit/compile/two_widths.h"

#include <utility>

namespace nacre {

namespace {

class TwoWidths final : public CompiledKernel {
 public:
  TwoWidths(std::shared_ptr<CompiledKernel> wide, std::shared_ptr<CompiledKernel> single)
      : wide_(std::move(wide)), single_(std::move(single)) {}

  RunStatus run(const KernelArguments& arguments) const override {
    return arguments.count <= most_single ? single_->run(arguments) : wide_->run(arguments);
  }
  const Program& program() const override { return wide_->program(); }
  int lanes() const override { return wide_->lanes(); }
  const char* engine() const override { return wide_->engine(); }

  Fits fits() const override { return wide_->fits(); }
  State state() const override {
    const State state = wide_->state();
    return state == State::ready ? single_->state() : state;
  }
  std::optional<Code> code(bool single) const override {
    return single ? single_->code(true) : wide_->code(false);
  }
  bool wait() const override {
    const bool is_ready = wide_->wait();
    return single_->wait() && is_ready;
  }
  void cancel() override {
    wide_->cancel();
    single_->cancel();
  }
  void when_ended(std::function<void()> call) override {
    wide_->when_ended([single = single_, call = std::move(call)] { single->when_ended(call); });
  }
  CompileStats stats() const override { return wide_->stats(); }
  Diagnostics diagnostics() const override {
    Diagnostics all = wide_->diagnostics();
    const Diagnostics more = single_->diagnostics();
    for (const Diagnostic& one : more.all()) all.add(one);
    return all;
  }

 private:
  /// A pass of many lanes costs as much for one point as for all of them.
  static constexpr std::uint64_t most_single = 1;

  std::shared_ptr<CompiledKernel> wide_, single_;
};

}  // namespace

std::shared_ptr<CompiledKernel> of_two_widths(std::shared_ptr<CompiledKernel> wide,
                                              std::shared_ptr<CompiledKernel> single) {
  return std::make_shared<TwoWidths>(std::move(wide), std::move(single));
}

}  // namespace nacre
