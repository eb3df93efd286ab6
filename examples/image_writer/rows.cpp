#include "examples/image_writer/rows.h"

#include "examples/image_writer/checked_file.h"
#include "examples/image_writer/spec.h"

namespace nacre::host {

namespace {

class RowWriter final : public ImageWriter {
 public:
  RowWriter(const std::string& file, std::unique_ptr<OIIO::ImageOutput> output)
      : file_(file), output_(std::move(output)) {
    output_->set_ioproxy(&file_);
  }

  bool open(const std::string& file, const OIIO::ImageSpec& spec) {
    return output_->open(file, spec);
  }
  bool write(int first, int rows, const float* samples) override {
    return output_->write_scanlines(first, first + rows, 0, OIIO::TypeDesc::FLOAT, samples);
  }
  std::string finish() override {
    const bool closed = output_->close();
    const std::string of_system = file_.finish();
    return closed || !of_system.empty() ? of_system : problem();
  }
  std::string problem() const override { return failure(output_->geterror()); }

 private:
  CheckedFile file_;
  std::unique_ptr<OIIO::ImageOutput> output_;
};

}  // namespace

std::unique_ptr<ImageWriter> write_rows(const std::string& file, const char* writer,
                                        const ImageHeader& header, std::string& problem) {
  auto output = OIIO::ImageOutput::create(writer);
  if (output == nullptr) {
    problem = failure(OIIO::geterror());
    return nullptr;
  }
  auto made = std::make_unique<RowWriter>(file, std::move(output));
  if (made->open(file, spec_of(header))) return made;
  problem = made->problem();
  return nullptr;
}

}  // namespace nacre::host
