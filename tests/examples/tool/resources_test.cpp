// Where the system gives no more (memory, threads, room in files, a reader): one line, exit
// status 1, and nothing half-written.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>

#include "tests/examples/tool/tool_fixture.h"
#include "tests/support/sanitizer.h"

namespace nacre {
namespace {

constexpr std::string_view noise = R"(<materialx version="1.39"><nodegraph name="G">
  <noise2d name="n" type="color3"/>
  <output name="o" type="color3" nodename="n"/>
  <output name="p" type="color3" nodename="n"/>
</nodegraph></materialx>)";

class Resources : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    document_ = write("a.mtlx", noise);
  }

  std::string bake(const std::string& options) const {
    return " bake " + document_ + " --no-cache --output G/o --out " + file("out") + " " + options;
  }

  std::string write_plain_material() const {
    return write("m.mtlx", R"(<materialx version="1.39">
      <standard_surface name="S" type="surfaceshader"/>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      </surfacematerial></materialx>)");
  }

  /// It is there and can be read to its end.
  static bool is_whole(const std::string& path) {
    const auto in = OIIO::ImageInput::open(path);
    if (in == nullptr) return false;
    std::vector<float> texels(in->spec().image_pixels() *
                              static_cast<std::size_t>(in->spec().nchannels));
    return in->read_image(0, 0, 0, in->spec().nchannels, OIIO::TypeDesc::FLOAT, texels.data());
  }

  std::string document_;
};

TEST_F(Resources, StandardOutputThatIsFullOrClosed) {
  for (const std::string& command :
       {bake("--size 4"), " inspect " + document_, " inspect --json " + document_,
        " check " + document_, " convert " + document_ + " --out " + file("b.mtlx"),
        std::string(" --help"), std::string(" bake --help"), std::string(" --version")}) {
    EXPECT_EQ(shell("$NACRE" + command + " >/dev/full"), 1) << command;
    // What CLI11 prints fails without a reason.
    const bool has_reason = command.find(" --help") == command.npos && command != " --version";
    const std::string said = "standard output could not be written";
    EXPECT_TRUE(says(said + (has_reason ? "; found No space left" : ""))) << errors_;
    EXPECT_EQ(shell("$NACRE" + command + " >&-"), 1) << command;
    EXPECT_TRUE(says(said + (has_reason ? "; found Bad file" : ""))) << errors_;
    EXPECT_EQ(shell("$NACRE" + command), 0) << command << errors_;
  }
  // Nothing is to be printed, so nothing fails.
  EXPECT_EQ(shell("$NACRE" + bake("--size 4 -q") + " >&-"), 0) << errors_;
}

TEST_F(Resources, ClosedStreamsDoNotBecomeFilesOfOurs) {
  EXPECT_EQ(shell("$NACRE" + bake("--size 64") + " <&- >&- 2>&-"), 1);
  EXPECT_TRUE(is_whole(file("out/G.o.exr")));
}

TEST_F(Resources, NobodyReadsThePipe) {
  // The status of the first of a pipeline, which writes more than a pipe holds.
  EXPECT_EQ(shell("{ $NACRE inspect --dump program --dump assembly " + document_ + "; echo $? >" +
                  file("status") + "; } | true"),
            0);
  EXPECT_EQ(text_of(file("status")), "1\n");
  EXPECT_TRUE(says("Broken pipe")) << errors_;
}

TEST_F(Resources, FilesThatMayNotGrow) {
  if (thread_sanitizer) GTEST_SKIP() << "a file of the sanitizer's own may not grow either";
  for (const std::string format : {"exr", "png", "tx"}) {
    const std::string path = file("out/G.o." + format);
    ASSERT_EQ(shell("$NACRE" + bake("--size 96 --format " + format)), 0) << errors_;
    const auto whole = static_cast<long>(std::filesystem::file_size(path));
    const long blocks = whole / 512;  // dash's unit
    int failed = 0;
    for (const long limit :
         {1L, 2L, blocks / 4, blocks / 2, blocks - 2, blocks - 1, blocks, 2 * blocks}) {
      std::filesystem::remove_all(file("out"));
      const int status = shell("(ulimit -f " + std::to_string(limit) + "; $NACRE" +
                               bake("--size 96 --format " + format) + ")");
      // Textures differ by a few bytes from run to run: what counts is that it is whole.
      if (format != "tx") {
        EXPECT_EQ(status, limit * 512 >= whole ? 0 : 1) << format << limit;
      }
      EXPECT_EQ(says("[cannot-write]"), status == 1) << errors_;
      EXPECT_EQ(names_in(file("out")).size(), status == 0 ? 1u : 0u);
      if (status == 0) {
        EXPECT_TRUE(is_whole(path)) << format << limit;
      }
      failed += status == 1;
    }
    EXPECT_GT(failed, 3) << format;
  }
}

TEST_F(Resources, RendersThatMayNotGrow) {
  if (thread_sanitizer) GTEST_SKIP() << "a file of the sanitizer's own may not grow either";
  const std::string scene = write_plain_material();
  for (const std::string name : {"a.png", "a.exr"}) {
    EXPECT_EQ(shell("(ulimit -f 4; $NACRE render " + scene +
                    " --no-cache --spp 1 --size 64 --out " + file(name) + ")"),
              1)
        << errors_;
    EXPECT_TRUE(says("[cannot-write]")) << errors_;
    EXPECT_FALSE(std::filesystem::exists(file(name)));
  }
}

TEST_F(Resources, ThreadsThatNoMachineHas) {
  EXPECT_EQ(shell("$NACRE" + bake("--size 4 --threads 100000")), 2);
  EXPECT_TRUE(says("--threads")) << errors_;
  EXPECT_EQ(shell("$NACRE" + bake("--size 4 --threads -1")), 2);
  EXPECT_EQ(shell("$NACRE" + bake("--size 4 --threads 16")), 0);
  EXPECT_EQ(errors_, "");
}

// Kilobytes of address space, from what loads the program at all to what is enough.
TEST_F(Resources, Memory) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer's own memory does not fit";
  const bool all = std::getenv("NACRE_TEST_FULL") != nullptr;
  int failed = 0;
  for (long kilobytes = 180'000; kilobytes <= 1'300'000; kilobytes += all ? 20'000 : 80'000) {
    std::filesystem::remove_all(file("out"));
    const int status = shell("(ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + "; $NACRE" +
                             bake("--size 2048 --threads 3") + ")");
    // The loader's, or a library's while it is loaded: not all of them fit.
    if (status == 127 || says("GnuTLS")) continue;
    if (status == 0) {
      EXPECT_TRUE(is_whole(file("out/G.o.exr")));
      continue;
    }
    ++failed;
    EXPECT_EQ(status, 1) << kilobytes << '\n' << errors_;
    EXPECT_TRUE(says("[out-of-memory]") || says("[system]") || says("[no-jit]") ||
                says("[cannot-write]"))
        << kilobytes << '\n'
        << errors_;
    EXPECT_TRUE(names_in(file("out")).empty());
    // Programs are told the same.
    std::filesystem::remove_all(file("out"));
    const int told = shell("(ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + "; $NACRE" +
                           bake("--size 2048 --threads 3 --json") + ")");
    if (told == 0 || says("GnuTLS")) continue;
    EXPECT_EQ(told, 1) << kilobytes << '\n' << errors_;
    EXPECT_EQ(errors_.find("{\"severity\":"), 0u) << kilobytes << '\n' << errors_;
  }
  EXPECT_GT(failed, 0);
}

TEST_F(Resources, MemoryOfRenders) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer's own memory does not fit";
  const bool all = std::getenv("NACRE_TEST_FULL") != nullptr;
  const std::string material = write_plain_material();
  int failed = 0;
  for (long kilobytes = 500'000; kilobytes <= 1'300'000; kilobytes += all ? 20'000 : 100'000) {
    std::filesystem::remove(file("a.png"));
    const int status =
        shell("(ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + "; $NACRE render " +
              material + " --no-cache --spp 1 --size 256 --threads 3 --out " + file("a.png") + ")");
    if (status == 127 || says("GnuTLS")) continue;
    if (status == 0) {
      EXPECT_TRUE(is_whole(file("a.png")));
      continue;
    }
    ++failed;
    EXPECT_EQ(status, 1) << kilobytes << '\n' << errors_;
    EXPECT_NE(errors_, "") << kilobytes;
    EXPECT_FALSE(std::filesystem::exists(file("a.png")));
  }
  EXPECT_GT(failed, 0);
}

// Root has as many processes as it likes.
TEST_F(Resources, Processes) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer starts threads of its own";
  const std::string as_nobody =
      ::geteuid() == 0 ? "setpriv --reuid 65534 --clear-groups " : std::string();
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
  for (const int most : {1, 2, 3, 4, 6, 8, 16}) {
    const int status =
        shell("ulimit -c 0; " + as_nobody + "prlimit --nproc=" + std::to_string(most) + " $NACRE" +
              bake("--size 64 --threads 4"));
    EXPECT_TRUE(status == 0 || status == 1) << status << errors_;
    if (status == 0) {
      EXPECT_TRUE(is_whole(file("out/G.o.exr")));
    }
    if (status == 1) {
      EXPECT_NE(errors_, "");
    }
  }
}

}  // namespace
}  // namespace nacre
