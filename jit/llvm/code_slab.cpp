#include "jit/llvm/code_slab.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace nacre {

namespace {

/// The first run of so many pages, cut from the free ones.
std::optional<std::size_t> cut(std::map<std::size_t, std::size_t>& runs, std::size_t pages) {
  const auto fits = [pages](const auto& run) { return run.second >= pages; };
  const auto found = std::ranges::find_if(runs, fits);
  if (found == runs.end()) return std::nullopt;
  const auto [first, count] = *found;
  runs.erase(found);
  if (count > pages) runs[first + pages] = count - pages;
  return first;
}

void join(std::map<std::size_t, std::size_t>& runs, std::size_t first, std::size_t pages) {
  if (pages == 0) return;
  auto run = runs.emplace(first, pages).first;
  const auto following = std::next(run);
  if (following != runs.end() && following->first == first + pages) {
    run->second += following->second;
    runs.erase(following);
  }
  if (run == runs.begin()) return;
  const auto before = std::prev(run);
  if (before->first + before->second != run->first) return;
  before->second += run->second;
  runs.erase(run);
}

}  // namespace

std::size_t CodeSlab::page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

std::unique_ptr<CodeSlab> CodeSlab::create(std::size_t pages) {
  constexpr std::size_t usual_bytes = 8u << 20;
  pages = std::max(pages, usual_bytes / page_size());
  const std::size_t bytes = pages * page_size();
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  std::unique_ptr<CodeSlab> slab(new CodeSlab(static_cast<char*>(memory), pages));
  // Linux joins areas again only if their pages have one owner (anon_vma), which the first
  // page that is written gives the area it is in: now, that is the whole slab.
  *slab->base_ = 0;
  return slab->set(slab->base_, pages, PROT_READ) ? std::move(slab) : nullptr;
}

CodeSlab::~CodeSlab() { munmap(base_, pages_ * page_size()); }

bool CodeSlab::take(std::size_t code, std::size_t data, CodePages& pages) {
  const std::optional<std::size_t> old_code = cut(free_code_, code);
  const std::optional<std::size_t> old_data = cut(free_data_, data);
  const std::size_t middle = data_begin_ - code_end_;
  if ((old_code ? 0 : code) + (old_data ? 0 : data) > middle) {
    if (old_code) join(free_code_, *old_code, code);
    if (old_data) join(free_data_, *old_data, data);
    return false;
  }
  const std::size_t first_code = old_code.value_or(code_end_);
  if (!old_code) code_end_ += code;
  if (!old_data) data_begin_ -= data;
  const std::size_t first_data = old_data.value_or(data_begin_);
  used_ += code + data;
  pages = {this, base_ + first_code * page_size(), code, base_ + first_data * page_size(), data};
  return true;
}

bool CodeSlab::protect(const CodePages& pages, State state) {
  const bool writable = state == State::writable;
  constexpr int write = PROT_READ | PROT_WRITE;
  return set(pages.code, pages.code_pages, writable ? write : PROT_READ | PROT_EXEC) &&
         set(pages.data, pages.data_pages, writable ? write : PROT_READ);
}

void CodeSlab::give_back(const CodePages& pages) {
  give_back(free_code_, pages.code, pages.code_pages);
  give_back(free_data_, pages.data, pages.data_pages);
}

bool CodeSlab::set(const char* start, std::size_t pages, int protection) {
  if (pages == 0) return true;
  return mprotect(const_cast<char*>(start), pages * page_size(), protection) == 0;
}

void CodeSlab::give_back(Runs& runs, const char* start, std::size_t pages) {
  if (pages == 0) return;
  // Zeros when next read; the protection stays, and with it the area.
  madvise(const_cast<char*>(start), pages * page_size(), MADV_DONTNEED);
  join(runs, static_cast<std::size_t>(start - base_) / page_size(), pages);
  used_ -= pages;
}

}  // namespace nacre
