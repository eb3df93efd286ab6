#include "runtime/module.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <latch>
#include <string>
#include <thread>
#include <vector>

#include "runtime/own_file.h"

namespace nacre {
namespace {

TEST(Module, ThatIsNotThereIsSaidWithItsPlaces) {
  ModuleFault fault;
  EXPECT_EQ(open_module("nacre_nonesuch", fault), nullptr);
  EXPECT_EQ(fault.found, "no such file");
  EXPECT_NE(fault.expected.find("/modules/nacre_nonesuch.so"), std::string::npos) << fault.expected;
}

TEST(Module, OfAnotherBuildIsRefused) {
  ModuleFault fault;
  EXPECT_EQ(open_module("test_foreign_module", fault), nullptr);
  EXPECT_EQ(fault.found, "one of another build");
  EXPECT_NE(fault.expected.find("test_foreign_module.so"), std::string::npos) << fault.expected;
}

TEST(Module, UnderAnotherNameIsRefused) {
  ModuleFault fault;
  EXPECT_EQ(open_module("test_renamed_module", fault), nullptr);
  EXPECT_EQ(fault.found, "another module");
}

TEST(Module, IsOneForAllThreads) {
  std::array<const ModuleHead*, 8> heads{};
  {
    std::vector<std::jthread> threads;
    for (const ModuleHead*& head : heads) {
      threads.emplace_back([&head] {
        ModuleFault fault;
        head = open_module("test_slow_module", fault);
      });
    }
  }
  ASSERT_NE(heads[0], nullptr);
  EXPECT_STREQ(heads[0]->name, "test_slow_module");
  for (const ModuleHead* head : heads) EXPECT_EQ(head, heads[0]);
}

/// The module says when its opening has begun, which then takes a while.
TEST(Module, ThatIsBeingOpenedIsOpenInAChildOfFork) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  ::setenv("NACRE_TEST_OPENING", std::to_string(pipe[1]).c_str(), 1);
  // The thread lives until the child has ended: one that has, and is not joined, is a leak to the
  // thread sanitizer of the child, where nobody can join it.
  std::latch over(1);
  const std::jthread other([&over] {
    ModuleFault fault;
    open_module("test_forked_module", fault);
    over.wait();
  });
  char byte = 0;
  EXPECT_EQ(::read(pipe[0], &byte, 1), 1);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(30);
    ModuleFault fault;
    ::_exit(open_module("test_forked_module", fault) == nullptr ? 1 : 0);
  }
  int status = 0;
  const pid_t ended = ::waitpid(child, &status, 0);
  over.count_down();
  ASSERT_EQ(ended, child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(OwnFile, IsLookedForBelowThePrefixAndThenInTheBuild) {
  const auto places = places_of({"share/what", "bin/what"});
  ASSERT_EQ(places.size(), 3u);
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(places[0], program.parent_path().parent_path() / "share/what");
  EXPECT_EQ(places[1], program.parent_path().parent_path().parent_path() / "share/what");
  EXPECT_EQ(places[2], std::filesystem::weakly_canonical(BUILD_FOLDER) / "bin/what");
  EXPECT_EQ(find_own_file({"share/what", "bin/what"}), "");
}

}  // namespace
}  // namespace nacre
