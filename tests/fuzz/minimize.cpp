#include "tests/fuzz/minimize.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace nacre::fuzz {

std::string ending(const std::function<void()>& run) {
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process == 0) {
    dup2(open("/dev/null", O_WRONLY), 2);
    const rlimit limit{20, 20};
    setrlimit(RLIMIT_CPU, &limit);
    run();
    _exit(0);
  }
  int status = 0;
  waitpid(process, &status, 0);
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return number == SIGXCPU ? "time" : "signal " + std::to_string(number);
  }
  return WEXITSTATUS(status) == 0 ? "" : "exit " + std::to_string(WEXITSTATUS(status));
}

Tree minimize(Tree tree, const std::function<bool(const Tree&)>& fails_alike) {
  // From the outside in: what goes early takes most with it.
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (std::size_t i = 0; i < all_elements(tree).size(); ++i) {
      for (std::size_t k = 0; k < all_elements(tree)[i]->children.size();) {
        Tree candidate = tree;
        auto& children = all_elements(candidate)[i]->children;
        children.erase(children.begin() + static_cast<std::ptrdiff_t>(k));
        if (fails_alike(candidate)) {
          tree = std::move(candidate);
          smaller = true;
        } else {
          ++k;
        }
      }
      for (std::size_t k = 0; k < all_elements(tree)[i]->attributes.size();) {
        Tree candidate = tree;
        auto& attributes = all_elements(candidate)[i]->attributes;
        attributes.erase(attributes.begin() + static_cast<std::ptrdiff_t>(k));
        if (fails_alike(candidate)) {
          tree = std::move(candidate);
          smaller = true;
        } else {
          ++k;
        }
      }
    }
  }
  return tree;
}

}  // namespace nacre::fuzz
