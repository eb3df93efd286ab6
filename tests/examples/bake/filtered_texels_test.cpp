// Samples of --samples auto where images are filtered: means of known images in closed form.
#include <cmath>
#include <vector>

#include "tests/examples/bake/bake_fixture.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

/// A grey image of bytes, its sides, and what is looked up in it.
class FilteredSamples : public Bake {
 protected:
  struct Image {
    int side;
    std::vector<unsigned char> bytes;  ///< From the top.
  };

  static Image random_image(int side) {
    Random random(20261127);
    Image image{side, {}};
    for (int i = 0; i < side * side; ++i) {
      image.bytes.push_back(static_cast<unsigned char>(random.below(256)));
    }
    return image;
  }

  /// 0 and 255 in turn along rows and columns.
  static Image board(int side) {
    Image image{side, {}};
    for (int i = 0; i < side * side; ++i) {
      image.bytes.push_back((i / side + i % side) % 2 == 0 ? 0 : 255);
    }
    return image;
  }

  /// The nodes are given the image as "image".
  std::unique_ptr<const OutputKernel> kernel_for(const Image& image, const std::string& nodes) {
    return kernel_of(grey_image(image.side, image.bytes) + nodes);
  }

  static host::BakeSettings of(int size, float error) {
    host::BakeSettings settings;
    settings.width = settings.height = size;
    settings.threads = 1;
    settings.sampling = {0, error};
    return settings;
  }

  struct Baked {
    std::vector<float> texels;
    host::BakeCounts counts;
  };

  static Baked bake(const OutputKernel& kernel, const host::BakeSettings& settings,
                    int block_rows = 8) {
    Baked baked;
    const auto append = [&](host::BakedRows& rows) {
      return [&baked, plane = std::move(rows.planes[0])] {
        baked.texels.insert(baked.texels.end(), plane.begin(), plane.end());
        return true;
      };
    };
    EXPECT_EQ(host::bake(kernel, 0, settings, block_rows, append, {}, &baked.counts),
              host::BakeResult::done);
    return baked;
  }
};

const char* const as_it_is =
    "<multiply name='n' type='float'><input name='in1' type='float' nodename='image'/>"
    "<input name='in2' type='float' value='1'/></multiply>";

/// The mean over the texel (x, y) of 16 by 16, by weights of the image's texels along an axis, from
/// the one before the texel's four to the one behind them.
double mean_of(const std::vector<unsigned char>& bytes, int x, int y, const double (&weights)[6]) {
  double sum = 0.0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      const int row = (4 * y + j - 1 + 64) % 64, column = (4 * x + i - 1 + 64) % 64;
      sum += weights[j] * weights[i] * bytes[static_cast<std::size_t>(row * 64 + column)];
    }
  }
  return sum / 16.0 / 255.0;
}

TEST_F(FilteredSamples, OfWholeTexelsOfAnImageAreTheirMeansAtOnce) {
  const Image image = random_image(64);
  const auto kernel = kernel_for(image, as_it_is);
  ASSERT_NE(kernel, nullptr);
  const Baked baked = bake(*kernel, of(16, 0.1f));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(baked.texels[static_cast<std::size_t>(16 * y + x)],
                  mean_of(image.bytes, x, y, {0, 1, 1, 1, 1, 0}), 0.5 / 255.0)
          << x << " " << y;
    }
  }
  // 1 and 2 x 2, two rows twice that are around blocks, and those of a look ahead at one texel.
  EXPECT_EQ(baked.counts.samples, 5u * 16u * 18u + 4u + 16u + 64u + 256u + 1024u);
  EXPECT_EQ(baked.counts.unfinished, 0u);
}

// Between texels images are linear, which takes an eighth of a texel's weight to both sides.
TEST_F(FilteredSamples, ConvergeToTheMeanOfWhatIsBetweenTexels) {
  const Image image = random_image(64);
  const auto kernel = kernel_for(image, as_it_is);
  ASSERT_NE(kernel, nullptr);
  const std::vector<float> texels = bake(*kernel, of(16, 1e-3f)).texels;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(texels[static_cast<std::size_t>(16 * y + x)],
                  mean_of(image.bytes, x, y, {0.125, 0.875, 1, 1, 0.875, 0.125}), 1e-3)
          << x << " " << y;
    }
  }
}

// Between the middles of four texels of a board the look-up is 1/2 + (1 - 2s) (1 - 2t) / 2, so
// that the mean of its square less 1/2 is 1/4 * 1/3 * 1/3. Coarser levels are 1/2 all over, and
// agree with one another: only a look ahead finds out.
TEST_F(FilteredSamples, DetailThatIsInNoCoarseMeanIsFound) {
  const auto kernel =
      kernel_for(board(16),
                 "<subtract name='d' type='float'><input name='in1' type='float' nodename='image'/>"
                 "<input name='in2' type='float' value='0.5'/></subtract>"
                 "<multiply name='n' type='float'><input name='in1' type='float' nodename='d'/>"
                 "<input name='in2' type='float' nodename='d'/></multiply>");
  ASSERT_NE(kernel, nullptr);
  const Baked baked = bake(*kernel, of(4, 1e-3f));
  for (const float texel : baked.texels) EXPECT_NEAR(texel, 1.0 / 36.0, 1e-3);
}

TEST_F(FilteredSamples, BitsAndCountsDoNotDependOnThreadsOrBlocks) {
  const auto kernel = kernel_for(
      random_image(128),
      "<ifgreater name='n' type='float'><input name='value1' type='float' nodename='image'/>"
      "<input name='value2' type='float' value='0.55'/>"
      "<input name='in1' type='float' value='1'/>"
      "<input name='in2' type='float' value='0'/></ifgreater>");
  ASSERT_NE(kernel, nullptr);
  host::BakeSettings settings = of(61, 0.05f);
  const Baked one = bake(*kernel, settings, 61);
  EXPECT_GT(one.counts.samples, 5u * 61u * 61u);
  for (const int threads : {1, 2, 5}) {
    settings.threads = threads;
    for (const int block_rows : {61, 16}) {
      const Baked again = bake(*kernel, settings, block_rows);
      EXPECT_EQ(again.texels, one.texels) << threads << " " << block_rows;
    }
    EXPECT_EQ(bake(*kernel, settings, 16).counts.samples,
              bake(*kernel, of(61, 0.05f), 16).counts.samples);
  }
}

TEST_F(FilteredSamples, WhatIsStillTooFarOffIsCounted) {
  const auto kernel = kernel_for(random_image(512), as_it_is);
  ASSERT_NE(kernel, nullptr);
  EXPECT_EQ(bake(*kernel, of(5, 0.05f)).counts.unfinished, 0u);
  EXPECT_GT(bake(*kernel, of(5, 1e-6f)).counts.unfinished, 0u);
}

}  // namespace
}  // namespace nacre
