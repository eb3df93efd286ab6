// Bakes and renders that are stopped or killed at any time: the status says so, what is
// there is whole and right, and the next run leaves no litter.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "tests/examples/tool/tool_process.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<float> texels_of(const std::string& path) {
  const auto in = OIIO::ImageInput::open(path);
  if (in == nullptr) return {};
  const int channels = in->spec().nchannels;
  std::vector<float> texels(in->spec().image_pixels() * static_cast<std::size_t>(channels));
  if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, texels.data())) return {};
  return texels;
}

class Stopped : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    std::string text = "<materialx version=\"1.39\"><nodegraph name=\"G\">";
    for (const std::string& name : outputs) {
      text += "<noise2d name=\"n" + name +
              "\" type=\"color3\"><input name=\"pivot\" type=\"float\" "
              "value=\"0." +
              name + "\"/></noise2d><output name=\"o" + name + "\" type=\"color3\" nodename=\"n" +
              name + "\"/>";
    }
    text +=
        "</nodegraph><standard_surface name=\"S\" type=\"surfaceshader\"><input "
        "name=\"base_color\" type=\"color3\" nodegraph=\"G\" output=\"o1\"/></standard_surface>"
        "<surfacematerial name=\"M\" type=\"material\"><input name=\"surfaceshader\" "
        "type=\"surfaceshader\" nodename=\"S\"/></surfacematerial></materialx>";
    document_ = write("a.mtlx", text);
  }

  std::vector<std::string> bake(const std::string& size) const {
    return {"bake", document_, "--cache", file("cache"), "--size", size, "--out", file("out")};
  }

  /// The seconds until the process is gone, its wait status in `status`.
  double stopped_after(const std::vector<std::string>& arguments, double delay, int signal,
                       int& status) {
    const Process process(arguments, file("stderr"));
    std::this_thread::sleep_for(std::chrono::duration<double>(delay));
    const auto start = Clock::now();
    process.send(signal);
    status = process.wait();
    errors_ = text_of(file("stderr"));
    return seconds_since(start);
  }

  const std::vector<std::string> outputs{"1", "2", "3", "4"};
  std::string document_;
};

TEST_F(Stopped, KilledBakesLeaveNothingWrong) {
  const auto begin = Clock::now();
  const Process whole(bake("512"), file("stderr"));
  ASSERT_EQ(whole.wait(), 0) << text_of(file("stderr"));
  double duration = seconds_since(begin);
  std::map<std::string, std::vector<float>> right;
  for (const std::string& name : names_in(file("out"))) {
    right[name] = texels_of(file("out/" + name));
  }
  ASSERT_EQ(right.size(), outputs.size());

  const int kills = std::getenv("NACRE_TEST_FULL") != nullptr ? 200 : 20;
  std::mt19937 random(5489);
  std::uniform_real_distribution<double> share(0.0, 1.1);
  int stopped = 0;
  for (int i = 0; i < kills; ++i) {
    // Kernels are sometimes compiled and sometimes found, over what the last run has left.
    if (i % 3 == 0) std::filesystem::remove_all(file("cache"));
    if (i % 4 == 0) std::filesystem::remove_all(file("out"));
    const int signal = std::array{SIGTERM, SIGINT, SIGKILL}[static_cast<std::size_t>(i % 3)];
    for (const auto& [name, texels] : right) std::filesystem::remove(file("out/" + name));
    const std::set<std::string> before = names_in(file("out"));
    int status = 0;
    stopped_after(bake("512"), share(random) * duration, signal, status);
    std::size_t there = 0;
    for (const auto& [name, texels] : right) {
      if (!std::filesystem::exists(file("out/" + name))) continue;
      ++there;
      EXPECT_EQ(texels_of(file("out/" + name)), texels) << name << " after signal " << signal;
    }
    if (status == 0) {
      EXPECT_EQ(there, right.size()) << errors_;
      duration *= 0.9;  // The machine may have been busier when it was measured.
      continue;
    }
    ++stopped;
    ASSERT_TRUE(WIFSIGNALED(status)) << errors_;
    EXPECT_EQ(WTERMSIG(status), signal);
    // Whatever we are asked for we clean up after; SIGKILL leaves that to the next run.
    if (signal != SIGKILL) {
      for (const std::string& name : names_in(file("out"))) {
        EXPECT_TRUE(right.contains(name) || before.contains(name)) << name;
      }
    }
  }
  EXPECT_GT(stopped, kills / 2);
  const Process last(bake("512"), file("stderr"));
  ASSERT_EQ(last.wait(), 0) << text_of(file("stderr"));
  EXPECT_EQ(names_in(file("out")).size(), right.size());
  for (const auto& [name, texels] : right) EXPECT_EQ(texels_of(file("out/" + name)), texels);
  for (const std::string& name : names_in(file("cache"))) {
    EXPECT_FALSE(name.starts_with(".writing-")) << name;
  }
}

// A manifest says which maps are whole; what was at work when it was killed is baked again.
TEST_F(Stopped, KilledBakesOfMeshesGoOnToTheSameBytes) {
  const auto bake_into = [this](const std::string& folder) {
    std::vector<std::string> arguments{
        "bake",  document_,    "--cache",    file("cache"),
        "--out", file(folder), "--manifest", file(folder + "/m.json")};
    for (const char* more : {"--scene", "builtin", "--mesh", "ball", "--samples", "16", "--size",
                             "256", "--dilate", "4"}) {
      arguments.emplace_back(more);
    }
    return arguments;
  };
  const auto begin = Clock::now();
  const Process whole(bake_into("whole"), file("stderr"));
  ASSERT_EQ(whole.wait(), 0) << text_of(file("stderr"));
  const double duration = seconds_since(begin);
  std::mt19937 random(5489);
  std::uniform_real_distribution<double> share(0.0, 0.8);
  int killed = 0;
  for (int i = 0; i < 12; ++i) {
    if (i % 4 == 0) std::filesystem::remove_all(file("out"));
    int status = 0;
    stopped_after(bake_into("out"), share(random) * duration, SIGKILL, status);
    if (WIFSIGNALED(status)) ++killed;
  }
  EXPECT_GT(killed, 3);
  const Process last(bake_into("out"), file("stderr"));
  ASSERT_EQ(last.wait(), 0) << text_of(file("stderr"));
  EXPECT_EQ(names_in(file("out")), names_in(file("whole")));
  for (const std::string& name : names_in(file("whole"))) {
    if (name == "m.json") continue;  // It has times.
    EXPECT_EQ(text_of(file("out/" + name)), text_of(file("whole/" + name))) << name;
  }
}

// Work for minutes, stopped when it has begun.
TEST_F(Stopped, EndsSoonAndSaysWhatIsMissing) {
  struct Work {
    std::vector<std::string> arguments;
    std::string folder;  ///< Where it has a partial file once it works; "": nowhere.
    std::string missing;
  };
  const std::vector<Work> work = {
      {{"bake", document_, "--backend", "reference", "--size", "16384", "--out", file("out")},
       file("out"),
       "expected 4 files, not written: " + file("out/G.o1.exr")},
      {{"bake", document_, "--backend", "reference", "--size", "16384", "--document",
        file("new/b.mtlx")},
       file("new"),
       "expected 1 file, not written: " + file("new/b.mtlx")},
      // Before all pixels have something.
      {{"render", document_, "--size", "4096", "--spp", "1000", "--out", file("big.exr")},
       "",
       "expected 1 file, not written: " + file("big.exr")}};
  const auto has_begun = [&](const Work& each, const Process& process, int signal) {
    if (each.folder.empty()) return process.handles(signal);
    const std::set<std::string> names = names_in(each.folder);
    return std::ranges::any_of(names, [](const auto& name) { return name.starts_with(".nacre-"); });
  };
  for (const Work& each : work) {
    const bool is_picture = each.arguments[0] == "render";
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
      if (is_picture && signal != SIGINT) continue;  // It takes five seconds.
      const Process process(each.arguments, file("stderr"));
      const auto begin = Clock::now();
      while (!has_begun(each, process, signal) && seconds_since(begin) < 120) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
      std::this_thread::sleep_for(std::chrono::seconds(1));
      const auto start = Clock::now();
      process.send(signal);
      const int status = process.wait();
      errors_ = text_of(file("stderr"));
      // Half a second where nothing else runs, and five for a picture that may become whole in
      // that time; without looking at the signal, minutes.
      EXPECT_LT(seconds_since(start), is_picture ? 10.0 : 5.0);
      ASSERT_TRUE(WIFSIGNALED(status)) << errors_;
      EXPECT_EQ(WTERMSIG(status), signal);
      EXPECT_TRUE(says("[stopped]")) << errors_;
      EXPECT_TRUE(says(each.missing)) << errors_;
      EXPECT_TRUE(names_in(file("out")).empty());
      EXPECT_TRUE(names_in(file("new")).empty());
    }
  }
}

// A render that is stopped gives what it has, if every pixel has something.
TEST_F(Stopped, RendersEndWithTheSamplesThatThereAre) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const Process process(
        {"render", document_, "--size", "64", "--spp", "100000000", "--out", file("a.exr")},
        file("stderr"));
    const auto begin = Clock::now();
    while (!process.handles(signal) && seconds_since(begin) < 120) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    std::this_thread::sleep_for(std::chrono::seconds(2));
    process.send(signal);
    const int status = process.wait();
    errors_ = text_of(file("stderr"));
    ASSERT_TRUE(WIFSIGNALED(status)) << errors_;
    EXPECT_EQ(WTERMSIG(status), signal);
    const bool is_there = std::filesystem::exists(file("a.exr"));
    EXPECT_TRUE(is_there ? says(file("a.exr") + " has ") && says("of 100000000 samples a pixel")
                         : says("expected 1 file, not written: " + file("a.exr")))
        << errors_;
    EXPECT_EQ(texels_of(file("a.exr")).size(), is_there ? 64u * 64 * 3 : 0u);
    std::filesystem::remove(file("a.exr"));
  }
}

// Killed again and again, and gone on with: the bytes of a render that nobody disturbed.
TEST_F(Stopped, KilledRendersGoOnFromTheirCheckpoint) {
  const std::vector<std::string> asked = {"render", document_, "--size", "96",
                                          "--spp",  "512",     "--aov",  "direct,crypto_object"};
  const auto with = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> all = asked;
    all.insert(all.end(), more);
    return all;
  };
  ASSERT_EQ(Process(with({"--out", file("whole.exr")}), file("stderr")).wait(), 0)
      << text_of(file("stderr"));
  const auto resumed = with(
      {"--out", file("a.exr"), "--checkpoint", file("a.checkpoint"), "--checkpoint-every", "0.05"});
  int killed = 0;
  for (int k = 0; k < 6; ++k) {
    const Process process(resumed, file("stderr"));
    std::this_thread::sleep_for(std::chrono::milliseconds(300 + 150 * k));
    process.send(SIGKILL);
    killed += WIFSIGNALED(process.wait());
  }
  ASSERT_EQ(Process(resumed, file("stderr")).wait(), 0) << text_of(file("stderr"));
  EXPECT_GT(killed, 0);
  EXPECT_EQ(text_of(file("a.exr")), text_of(file("whole.exr")));
  // Of another document there is nothing to go on with.
  std::ofstream(document_, std::ios::app) << "<!-- changed -->\n";
  EXPECT_NE(Process(resumed, file("stderr")).wait(), 0);
  EXPECT_NE(text_of(file("stderr")).find("[bad-checkpoint]"), std::string::npos);
}

TEST_F(Stopped, SignalsThatAreIgnoredStayIgnored) {
  std::signal(SIGHUP, SIG_IGN);  // What a process has ignored its children have, too.
  const Process process(bake("1024"), file("stderr"));
  std::signal(SIGHUP, SIG_DFL);
  const auto begin = Clock::now();
  while (!process.handles(SIGTERM) && seconds_since(begin) < 120) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(process.handles(SIGHUP));
  process.send(SIGHUP);
  EXPECT_EQ(process.wait(), 0) << text_of(file("stderr"));
  EXPECT_EQ(names_in(file("out")).size(), outputs.size());
}

// Partial files of living processes are not swept.
TEST_F(Stopped, RunsSideBySideDoNotDisturbEachOther) {
  const Process one(bake("1024"), file("one"));
  const Process two(bake("1024"), file("two"));
  const Process three(bake("1024"), file("three"));
  EXPECT_EQ(one.wait(), 0) << text_of(file("one"));
  EXPECT_EQ(two.wait(), 0) << text_of(file("two"));
  EXPECT_EQ(three.wait(), 0) << text_of(file("three"));
  EXPECT_EQ(names_in(file("out")).size(), outputs.size());
}

}  // namespace
}  // namespace nacre
