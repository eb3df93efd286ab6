// Threads of a host's, what is compiled behind its back, and being told.
#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <nacre/nacre.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/jit/api/image_points.h"

namespace nacre {
namespace {

/// Keeps tasks until somebody runs them.
class Shelf {
 public:
  Executor executor() {
    return [this](std::function<void()> task) {
      const std::scoped_lock lock(mutex_);
      tasks_.push_back(std::move(task));
      changed_.notify_all();
    };
  }
  /// Runs one, waiting for it if need be.
  void run_one() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !tasks_.empty(); });
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
  }
  void wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.size() >= count; });
  }
  std::size_t size() {
    const std::scoped_lock lock(mutex_);
    return tasks_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
};

Document number_document(float number) {
  return Document::parse(
      R"(<materialx version="1.39"><position name="p" type="vector3"/>
         <multiply name="m" type="vector3"><input name="in1" type="vector3" nodename="p"/>
           <input name="in2" type="vector3" value=")" +
      std::to_string(number) + R"(, 1, 1"/></multiply>
         <output name="out" type="vector3" nodename="m"/></materialx>)");
}

CompileOptions in_background(int priority = 0) {
  CompileOptions options;
  options.background = true;
  options.priority = priority;
  return options;
}

SystemOptions with(Shelf& shelf) {
  SystemOptions options;
  options.executor = shelf.executor();
  return options;
}

TEST(ApiExecutor, TheHostsThreadsCompile) {
  Shelf shelf;
  System system(with(shelf));
  std::thread worker([&] { shelf.run_one(); });
  const Shader shader = system.compile_outputs(number_document(2), {"out"});
  worker.join();
  EXPECT_FALSE(shader.is_pending());
  EXPECT_NO_THROW(shader.wait());
}

TEST(ApiExecutor, NothingIsCompiledUntilTheHostDoes) {
  Shelf shelf;
  System system(with(shelf));
  const Shader shader = system.compile_outputs(number_document(3), {"out"}, in_background());
  int calls = 0;
  shader.when_ready([&] { ++calls; });
  EXPECT_TRUE(shader.is_pending());
  EXPECT_EQ(calls, 0);
  shelf.run_one();
  EXPECT_FALSE(shader.is_pending());
  EXPECT_EQ(calls, 1);
  shader.when_ready([&] { ++calls; });
  EXPECT_EQ(calls, 2);
}

TEST(ApiExecutor, HigherPrioritiesGoFirst) {
  Shelf shelf;
  System system(with(shelf));
  std::string order;
  std::vector<Shader> shaders;
  for (const int priority : {0, -5, 7}) {
    shaders.push_back(system.compile_outputs(number_document(4.0f + float(priority)), {"out"},
                                             in_background(priority)));
    shaders.back().when_ready([&order, priority] { order += std::to_string(priority) + ' '; });
  }
  for (int i = 0; i < 3; ++i) shelf.run_one();
  EXPECT_EQ(order, "7 0 -5 ");
}

TEST(ApiExecutor, WhatIsCancelledIsNotCompiled) {
  Shelf shelf;
  System system(with(shelf));
  const Shader shader = system.compile_outputs(number_document(5), {"out"}, in_background());
  shader.cancel();
  EXPECT_FALSE(shader.is_pending());
  try {
    shader.wait();
    ADD_FAILURE() << "it stays interpreted";
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u);
    EXPECT_EQ(error.diagnostics()[0].code, "cancelled");
  }
  shelf.run_one();
  Binder binder;
  for (const char* place : {"P", "Po"}) binder.constant(place, {1, 2, 3});
  binder.array("out", {0, 0, sizeof(Color)});
  for (const char* change : {"dPdx", "dPdy", "dPodx", "dPody"}) binder.constant(change, {0});
  const Binding binding(binder, shader);
  Color color{};
  Batch batch;
  batch.count = 1;
  binding.run(NACRE_OUTPUTS, std::vector<void*>{&color}, batch);
  EXPECT_EQ(color, (Color{5, 2, 3}));
}

TEST(ApiExecutor, WhatIsWaitedForGoesBeforeAnyPriority) {
  Shelf shelf;
  System system(with(shelf));
  bool was_first = false;
  const Shader behind = system.compile_outputs(number_document(7), {"out"}, in_background(1000));
  std::thread worker([&] {
    shelf.wait_for(2);
    shelf.run_one();
    was_first = behind.is_pending();
    shelf.run_one();
  });
  const Shader awaited = system.compile_outputs(number_document(8), {"out"});
  worker.join();
  EXPECT_TRUE(was_first);
  EXPECT_FALSE(behind.is_pending());
}

TEST(ApiExecutor, HooksAreDestroyedWhereTheSystemCannotBeMade) {
  int destroyed = 0;
  nacre_executor executor{};
  executor.size = sizeof executor;
  executor.user = &destroyed;
  executor.submit = [](void*, void (*run)(void*), void* task) { run(task); };
  executor.destroy = [](void* user) { ++*static_cast<int*>(user); };
  const char* const nowhere = "/nowhere";
  nacre_system_options options{};
  options.size = sizeof options;
  options.libraries = &nowhere;
  options.library_count = 1;
  options.executor = &executor;
  nacre_system* system = nullptr;
  EXPECT_EQ(nacre_system_create(&options, nullptr, &system), NACRE_FAILED);
  EXPECT_EQ(destroyed, 1);
}

TEST(ApiExecutor, TasksThatComeTooLateDoNothing) {
  Shelf shelf;
  int calls = 0;
  {
    System system(with(shelf));
    const Shader shader = system.compile_outputs(number_document(6), {"out"}, in_background());
    shader.when_ready([&] { ++calls; });
  }
  EXPECT_EQ(calls, 1);  // Given up.
  ASSERT_EQ(shelf.size(), 1u);
  shelf.run_one();
  EXPECT_EQ(calls, 1);
}

TEST(ApiReport, WhoListensIsToldAtOnce) {
  nacre_report* report = nullptr;
  ASSERT_EQ(nacre_report_create(&report), NACRE_OK);
  std::vector<std::string> heard;
  const auto hear = [](void* user, const nacre_diagnostic* diagnostic) {
    static_cast<std::vector<std::string>*>(user)->push_back(diagnostic->code);
  };
  nacre_report_listen(report, hear, &heard);
  nacre_document* document = nullptr;
  const auto read_nothing = [&] {
    nacre_document_read("/nowhere.mtlx", nullptr, report, &document);
  };
  read_nothing();
  EXPECT_EQ(heard, std::vector<std::string>{"cannot-read"});
  nacre_report_clear(report);
  read_nothing();
  EXPECT_EQ(heard.size(), 2u);
  EXPECT_EQ(nacre_report_count(report), 1u);
  nacre_report_listen(report, nullptr, nullptr);
  read_nothing();
  EXPECT_EQ(heard.size(), 2u);
  nacre_report_destroy(report);
}

}  // namespace
}  // namespace nacre
