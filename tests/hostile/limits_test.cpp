// Every limit: what just fits passes, one more is refused with its code.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>

#include "jit/shading/shading_system.h"
#include "tests/support/standard_library.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class Limits : public ::testing::Test {
 protected:
  fs::path write(const std::string& file, const std::string& text) const {
    return temporary_.write(file, text);
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

std::string wrapped(const std::string& body) {
  return "<materialx version=\"1.39\">" + body + "</materialx>";
}

/// Elements of which each inherits from the one before; the first has an input.
std::string heirs(const std::string& category, const std::string& attributes, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "<" + category + " name=\"h" + std::to_string(i) + "\" " + attributes;
    if (i > 0) text += " inherit=\"h" + std::to_string(i - 1) + "\"";
    text += i > 0 ? "/>" : "><input name=\"in\" type=\"float\" value=\"0.5\"/></" + category + ">";
  }
  return text;
}

/// The code of the one diagnostic of reading, "" if there is none.
std::string reading(const fs::path& file, const ReadLimits& limits) {
  Diagnostics diagnostics;
  ReadOptions options;
  options.limits = limits;
  const auto document = read_document(file, options, diagnostics);
  EXPECT_EQ(document == nullptr, diagnostics.has_errors());
  EXPECT_LE(diagnostics.all().size(), 1u) << diagnostics.to_string();
  return diagnostics.all().empty() ? "" : diagnostics.all().front().code;
}

TEST_F(Limits, BytesOfOneFile) {
  const fs::path file = write("a.mtlx", wrapped(""));
  ReadLimits limits;
  limits.file_bytes = fs::file_size(file);
  EXPECT_EQ(reading(file, limits), "");
  --limits.file_bytes;
  EXPECT_EQ(reading(file, limits), "file-too-large");
}

TEST_F(Limits, BytesAndFilesOfIncludes) {
  const fs::path part = write("part.mtlx", wrapped(""));
  const fs::path file =
      write("a.mtlx", wrapped("<xi:include href=\"part.mtlx\"/><xi:include href=\"part.mtlx\"/>"));
  ReadLimits limits;
  limits.files = 3;
  limits.total_bytes = fs::file_size(file) + 2 * fs::file_size(part);
  EXPECT_EQ(reading(file, limits), "");
  --limits.total_bytes;
  EXPECT_EQ(reading(file, limits), "too-many-includes");
  ++limits.total_bytes;
  limits.files = 2;
  EXPECT_EQ(reading(file, limits), "too-many-includes");
}

TEST_F(Limits, DepthOfIncludes) {
  write("c.mtlx", wrapped(""));
  write("b.mtlx", wrapped("<xi:include href=\"c.mtlx\"/>"));
  const fs::path file = write("a.mtlx", wrapped("<xi:include href=\"b.mtlx\"/>"));
  ReadLimits limits;
  limits.include_depth = 3;
  EXPECT_EQ(reading(file, limits), "");
  limits.include_depth = 2;
  EXPECT_EQ(reading(file, limits), "include-depth");
}

TEST_F(Limits, DepthAndNumberOfElements) {
  const fs::path file = write("a.mtlx", wrapped("<a><b><c/></b></a>"));
  ReadLimits limits;
  limits.xml_depth = 4;
  EXPECT_EQ(reading(file, limits), "");
  limits.xml_depth = 3;
  EXPECT_EQ(reading(file, limits), "too-deep");
  limits.xml_depth = 4;
  limits.elements = 4;
  EXPECT_EQ(reading(file, limits), "");
  limits.elements = 2;
  EXPECT_EQ(reading(file, limits), "too-many-elements");
}

constexpr const char* chain = R"(
  <position name="p" type="vector3"/>
  <sin name="a" type="vector3"><input name="in" type="vector3" nodename="p"/></sin>
  <sin name="b" type="vector3"><input name="in" type="vector3" nodename="a"/></sin>
  <output name="out" type="vector3" nodename="b"/>)";

/// A system without a cache; the data library is read once for all tests.
ShadingSystem& system() {
  static const std::unique_ptr<ShadingSystem> made = [] {
    Diagnostics diagnostics;
    SystemOptions options;
    options.libraries = {standard_library_folder()};
    options.textures.limits.max_size = 8;
    options.textures.tiles.max_tiles = 2;
    return ShadingSystem::create(options, diagnostics);
  }();
  return *made;
}

/// Compiles output "out" of `chain`.
std::unique_ptr<OutputKernel> compile(const ShaderOptions& options, Diagnostics& diagnostics) {
  Diagnostics reading;
  const auto document = read_document_text(wrapped(chain), "chain.mtlx", {}, reading);
  return system().compile_outputs(*document, {"out"}, options, diagnostics);
}

std::string compiling(const ShaderOptions& options) {
  Diagnostics diagnostics;
  const auto kernel = compile(options, diagnostics);
  EXPECT_EQ(kernel == nullptr, diagnostics.has_errors());
  return diagnostics.all().empty() ? "" : diagnostics.all().front().code;
}

TEST_F(Limits, NodesOfAGraph) {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  options.graph.max_nodes = 3;
  EXPECT_EQ(compiling(options), "");
  options.graph.max_nodes = 2;
  EXPECT_EQ(compiling(options), "too-many-nodes");
}

TEST_F(Limits, InputsOfANode) {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  options.graph.max_inputs = 1;
  EXPECT_EQ(compiling(options), "");
  options.graph.max_inputs = 0;
  EXPECT_EQ(compiling(options), "too-many-inputs");
}

TEST_F(Limits, InstructionsRecordedAndLowered) {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  options.compile.accuracy = Accuracy::precise;
  Diagnostics diagnostics;
  const auto kernel = compile(options, diagnostics);
  ASSERT_NE(kernel, nullptr);
  std::size_t recorded = 0;
  std::size_t most = 0;
  for (const StageReport& stage : kernel->stages) {
    if (stage.name.ends_with("slice")) recorded = stage.instructions;
    most = std::max(most, stage.instructions);
  }
  // Sines become polynomials: what fits when recorded need not fit afterwards.
  ASSERT_LT(recorded, most);
  options.compile.max_instructions = most;
  EXPECT_EQ(compiling(options), "");
  options.compile.max_instructions = most - 1;
  EXPECT_EQ(compiling(options), "program-too-large");
  options.compile.max_instructions = 1;
  EXPECT_EQ(compiling(options), "program-too-large");
}

TEST_F(Limits, TimeToCompile) {
  ShaderOptions options;
  options.compile.max_seconds = 0;
  Diagnostics diagnostics;
  const auto kernel = compile(options, diagnostics);
  ASSERT_NE(kernel, nullptr);
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.all().front().code, "compile-timeout");
  EXPECT_EQ(diagnostics.all().front().severity, Severity::warning);
  EXPECT_STREQ(kernel->kernel.kernel().engine(), "interpreter");

  options.compile.max_seconds = 600;
  Diagnostics none;
  const auto compiled = compile(options, none);
  ASSERT_NE(compiled, nullptr);
  EXPECT_TRUE(none.all().empty()) << none.to_string();
  const float at = 0.75f;
  const auto run = [&](const OutputKernel& one) {
    const std::vector<const void*> in(one.kernel.program().inputs.size(), &at);
    std::vector<float> values(one.kernel.program().outputs.size());
    std::vector<void*> out;
    for (float& value : values) out.push_back(&value);
    EXPECT_EQ(one.kernel.run(in, out, 1), RunStatus::done);
    return values;
  };
  EXPECT_EQ(run(*kernel), run(*compiled));
}

/// What checking a document with that limit says first, "" for nothing.
std::string checking(const std::string& text, std::size_t inheritance) {
  Diagnostics diagnostics;
  ReadOptions read;
  read.limits.inheritance = inheritance;
  const auto document = read_document_text(wrapped(text), "a.mtlx", read, diagnostics);
  if (document != nullptr) system().check(*document, {}, diagnostics);
  return diagnostics.all().empty() ? "" : diagnostics.all().front().code;
}

TEST_F(Limits, ChainsOfInheritance) {
  const std::string nodes = heirs("sin", "type=\"float\"", 5);
  const std::string looks =
      "<look name=\"h0\"/><look name=\"h1\" inherit=\"h0\"/><look name=\"h2\" inherit=\"h1\"/>";
  const std::string defs =
      "<nodedef name=\"a\" node=\"one\"><output name=\"out\" type=\"float\"/></nodedef>"
      "<nodedef name=\"b\" node=\"two\" inherit=\"a\"/>"
      "<nodedef name=\"c\" node=\"three\" inherit=\"b\"/>";
  EXPECT_EQ(checking(nodes, 5), "");
  EXPECT_EQ(checking(nodes, 4), "inherit-depth");
  EXPECT_EQ(checking(looks, 3), "");
  EXPECT_EQ(checking(looks, 2), "inherit-depth");
  EXPECT_EQ(checking(defs, 3), "");
  EXPECT_EQ(checking(defs, 2), "inherit-depth");
  // More than the default, where the limit says so; and compiling minds it too.
  const std::string many = heirs("sin", "type=\"float\"", 200) +
                           "<output name=\"out\" type=\"float\" nodename=\"h199\"/>";
  EXPECT_EQ(checking(many, 64), "inherit-depth");
  for (const std::size_t most : {std::size_t{64}, std::size_t{200}}) {
    Diagnostics diagnostics;
    ReadOptions read;
    read.limits.inheritance = most;
    const auto document = read_document_text(wrapped(many), "a.mtlx", read, diagnostics);
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    const auto kernel = system().compile_outputs(*document, {"out"}, options, diagnostics);
    EXPECT_EQ(kernel != nullptr, most == 200) << diagnostics.to_string();
    if (kernel == nullptr) continue;
    float value = 0;
    const std::vector<void*> out{&value};
    EXPECT_EQ(kernel->kernel.run({}, out, 1), RunStatus::done);
    EXPECT_NEAR(value, std::sin(0.5), 1e-6);  // The first one's input came all the way.
  }
}

/// A Targa file of grey pixels without compression (Truevision TGA, 2.0).
std::string targa(unsigned char width, unsigned char height) {
  std::string file(18, '\0');
  file[2] = 3;
  file[12] = static_cast<char>(width);
  file[14] = static_cast<char>(height);
  file[16] = 8;
  return file + std::string(std::size_t{width} * height, '\x40');
}

/// The complaints about a document that names an image, "code line:column path", one a line.
std::string naming(const fs::path& folder, const std::string& image) {
  std::ofstream(folder / "a.mtlx") << "<materialx version=\"1.39\">\n"
                                      "  <nodegraph name=\"NG\">\n"
                                      "    <image name=\"i\" type=\"float\">\n"
                                      "      <input name=\"file\" type=\"filename\" value=\""
                                   << image
                                   << "\"/>\n"
                                      "    </image>\n"
                                      "    <output name=\"out\" type=\"float\" nodename=\"i\"/>\n"
                                      "  </nodegraph>\n"
                                      "</materialx>\n";
  Diagnostics diagnostics;
  const auto document = read_document(folder / "a.mtlx", {}, diagnostics);
  if (document != nullptr) system().check(*document, {}, diagnostics);
  std::string said;
  for (const Diagnostic& one : diagnostics.all()) {
    EXPECT_EQ(one.where.file, (folder / "a.mtlx").string());
    EXPECT_EQ(one.severity, Severity::error);
    said += one.code + ' ' + std::to_string(one.where.line) + ':' +
            std::to_string(one.where.column) + ' ' + one.where.path + '\n';
  }
  return said;
}

TEST_F(Limits, SizeOfAnImage) {
  write("fits.tga", targa(8, 8));
  write("wide.tga", targa(9, 8));
  EXPECT_EQ(naming(folder_, "fits.tga"), "");
  EXPECT_EQ(naming(folder_, "wide.tga"), "image-too-large 3:6 NG/i\n");
}

TEST_F(Limits, TilesOfAName) {
  write("t.1001.tga", targa(2, 2));
  write("t.1002.tga", targa(2, 2));
  EXPECT_EQ(naming(folder_, "t.&lt;UDIM>.tga"), "");
  write("t.1003.tga", targa(2, 2));
  EXPECT_EQ(naming(folder_, "t.&lt;UDIM>.tga"), "too-many-files 3:6 NG/i\n");
}

// Names that lead where there is no image: said of the node that has them, whatever
// they are meant to reach.
TEST_F(Limits, FileNamesLeadNowhere) {
  write("empty.png", "");
  write("text.png", "root:x:0:0:root:/root:/bin/bash\n");
  const std::string missing = "missing-image 3:6 NG/i\n";
  const std::string unreadable = "unreadable-image 3:6 NG/i\n";
  const std::string unsupported = "unsupported-image 3:6 NG/i\n";
  const std::string outside = "image-outside 3:6 NG/i\n";
  EXPECT_EQ(naming(folder_, "gone.png"), missing);
  EXPECT_EQ(naming(folder_, "../../../../../../../../../../etc/passwd"), outside);
  for (const char* name : {"/etc/passwd", "/etc/shadow/a.png", "/dev/zero", "/proc/self/mem",
                           "/nowhere/a.png", "../gone/t.&lt;UDIM>.png"}) {
    EXPECT_EQ(naming(folder_, name), outside);
  }
  EXPECT_EQ(naming(folder_, "."), unreadable);
  EXPECT_EQ(naming(folder_, "\\\\server\\share\\a.png"), missing);
  EXPECT_EQ(naming(folder_, "C:\\textures\\a.png"), missing);
  EXPECT_EQ(naming(folder_, "%(HOME)/a.png"), missing);
  EXPECT_EQ(naming(folder_, "$HOME/a.png"), missing);
  EXPECT_EQ(naming(folder_, "~/a.png"), missing);
  EXPECT_EQ(naming(folder_, "https://example.com/a.png"), missing);
  EXPECT_EQ(naming(folder_, "a.png;rm -rf /"), missing);
  EXPECT_EQ(naming(folder_, std::string(300, 'a') + ".png"), missing);
  EXPECT_EQ(naming(folder_, std::string(100'000, 'a') + ".png"), missing);
  EXPECT_EQ(naming(folder_, "empty.png"), unreadable);
  EXPECT_EQ(naming(folder_, "text.png"), unsupported);
  EXPECT_EQ(naming(folder_, "gone.&lt;UDIM>.png"), missing);
  EXPECT_EQ(naming(folder_, "gone/t.&lt;UDIM>.png"), missing);
  EXPECT_EQ(naming(folder_, "t.&lt;UDIM>.&lt;UVTILE>.png"), "bad-tile-pattern 3:6 NG/i\n");
}

}  // namespace
}  // namespace nacre
