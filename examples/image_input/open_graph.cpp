#include "examples/image_input/open_graph.h"

#include <utility>

#include "examples/image_input/output_store.h"

namespace graph_image {

namespace {

class OpenedOutput final : public OpenedGraph {
 public:
  OpenedOutput(std::shared_ptr<const ReadyOutput> ready, const Request& request)
      : ready_(std::move(ready)),
        instance_(ready_->output->instance(request)),
        corner_u_(request.corner_u),
        corner_v_(request.corner_v) {}

  const GraphInfo& info() const override { return ready_->info; }
  std::vector<float> shade(const Level& level, const Texels& texels) const override {
    return ready_->output->shade(
        instance_,
        {level.width * level.samples_x, level.height * level.samples_y, corner_u_, corner_v_},
        level, texels);
  }

 private:
  std::shared_ptr<const ReadyOutput> ready_;
  nacre::Instance instance_;
  int corner_u_, corner_v_;
};

}  // namespace

std::unique_ptr<OpenedGraph> open_graph(const Request& request) {
  return std::make_unique<OpenedOutput>(shared_store().get(request), request);
}

}  // namespace graph_image
