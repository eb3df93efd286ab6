// Bakes that are killed at any time, again and again, and go on: what they have made in the end is
// what one makes that nobody disturbs, byte by byte.
#include <array>
#include <chrono>
#include <random>
#include <thread>

#include "tests/examples/tool/bake/farm_fixture.h"
#include "tests/examples/tool/tool_process.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class BakeKilled : public Farm {
 protected:
  std::vector<std::string> arguments(const std::string& folder, int run) const {
    return {"bake",
            file("a.mtlx"),
            "--udim",
            "auto",
            "--cache",
            file("cache"),
            "--document",
            file(folder + "/b.mtlx"),
            "--manifest",
            file("m/" + folder + ".json"),
            "--size",
            "192",
            "--samples",
            "16",
            "--clip",
            "--format",
            formats_[static_cast<std::size_t>(run) % 3]};
  }
  const std::array<std::string, 3> formats_{"exr", "png", "tx"};
};

TEST_F(BakeKilled, GoesOnWhereItWas) {
  std::array<std::map<std::string, std::string>, 3> right;
  double duration = 0.0;
  for (int format = 0; format < 3; ++format) {
    const std::string folder = "right" + std::to_string(format);
    const auto begin = Clock::now();
    ASSERT_EQ(Process(arguments(folder, format), file("stderr")).wait(), 0)
        << text_of(file("stderr"));
    duration = seconds_since(begin);
    right[static_cast<std::size_t>(format)] = baked(folder);
  }
  const int kills = std::getenv("NACRE_TEST_FULL") != nullptr ? 200 : 15;
  std::mt19937 random(5489);
  std::uniform_real_distribution<double> share(0.0, 0.8);
  int killed = 0;
  int ended = 0;
  int gone_on = 0;
  for (int run = 0; killed < kills || ended < 3;) {
    const auto& expected = right[static_cast<std::size_t>(run) % 3];
    const int signal = std::array{SIGKILL, SIGTERM, SIGINT}[static_cast<std::size_t>(killed) % 3];
    const Process process(arguments("out", run), file("stderr"));
    if (killed < kills) {
      std::this_thread::sleep_for(std::chrono::duration<double>(share(random) * duration));
      process.send(signal);
    }
    const int status = process.wait();
    for (const auto& [name, digest] : baked("out")) {
      if (name.starts_with(".nacre-")) continue;
      // A map that is the same everywhere has files until all of it is known.
      if (name.starts_with("S.metalness.")) continue;
      ASSERT_TRUE(expected.contains(name)) << name;
      EXPECT_EQ(digest, expected.at(name)) << name;
    }
    if (status != 0) {
      ASSERT_TRUE(WIFSIGNALED(status)) << text_of(file("stderr"));
      EXPECT_EQ(WTERMSIG(status), signal);
      ++killed;
      continue;
    }
    gone_on += text_of(file("stderr")).find("[already-there]") != std::string::npos ? 1 : 0;
    EXPECT_EQ(baked("out"), expected) << run;  // And no litter, which would be a name.
    for (const std::string& name : names_in(file("m")))
      EXPECT_TRUE(name.ends_with(".json")) << name;
    fs::remove_all(file("out"));
    fs::remove(file("m/out.json"));
    ++ended;
    ++run;
  }
  EXPECT_GT(gone_on, 0);
  RecordProperty("killed", killed);
  RecordProperty("ended", ended);
}

// What a process of another machine writes is let alone until nothing was written for long.
TEST_F(BakeKilled, LitterOfOthersIsTakenAwayOnceItIsOld) {
  const auto litter = [&](const std::string& machine) {
    const std::string folder = file("out/.nacre-" + machine + "-abcdef");
    fs::create_directories(folder);
    write("out/.nacre-" + machine + "-abcdef/a.exr", "x");
    return folder;
  };
  std::string here = text_of("/proc/sys/kernel/random/boot_id").substr(0, 8);
  const std::string ours = litter(here);
  const std::string theirs = litter("zzzzzzzz");
  const std::string old = litter("yyyyyyyy");
  const auto past = fs::file_time_type::clock::now() - std::chrono::hours(2);
  fs::last_write_time(old + "/a.exr", past);
  fs::last_write_time(old, past);
  EXPECT_EQ(bake_document("out", "--shard 1/20"), 0) << errors_;
  EXPECT_FALSE(fs::exists(ours));
  EXPECT_TRUE(fs::exists(theirs));
  EXPECT_FALSE(fs::exists(old));
}

}  // namespace
}  // namespace nacre
