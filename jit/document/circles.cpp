#include "jit/document/circles.h"

#include <algorithm>

namespace nacre {

namespace {

class Circles {
 public:
  using LeadsTo = std::function<std::vector<const Element*>(const Element&)>;

  explicit Circles(const LeadsTo& leads_to) : leads_to_(leads_to) {}

  void visit(const Element& start) {
    if (order_.contains(&start)) return;
    open(start);
    while (!visits_.empty()) {
      Visit& visit = visits_.back();
      if (visit.next < visit.targets.size()) {
        const Element* target = visit.targets[visit.next++];
        const auto known = order_.find(target);
        if (known == order_.end()) {
          open(*target);
        } else if (!numbers.contains(target)) {  // still on the stack
          visit.lowest = std::min(visit.lowest, known->second);
        }
        continue;
      }
      close();
    }
  }

  std::unordered_map<const Element*, std::size_t> numbers;

 private:
  struct Visit {
    const Element* element;
    std::size_t lowest;  ///< Order of the earliest element on the stack it leads to.
    std::vector<const Element*> targets;
    std::size_t next = 0;
  };

  void open(const Element& element) {
    const std::size_t order = order_.size();
    order_.emplace(&element, order);
    stack_.push_back(&element);
    visits_.push_back({&element, order, leads_to_(element)});
  }

  void close() {
    const Visit done = std::move(visits_.back());
    visits_.pop_back();
    if (!visits_.empty()) visits_.back().lowest = std::min(visits_.back().lowest, done.lowest);
    if (done.lowest != order_.at(done.element)) return;
    const Element* last = nullptr;
    while (last != done.element) {
      last = stack_.back();
      stack_.pop_back();
      numbers.emplace(last, order_.at(done.element));
    }
  }

  const LeadsTo& leads_to_;
  std::unordered_map<const Element*, std::size_t> order_;
  std::vector<const Element*> stack_;
  std::vector<Visit> visits_;
};

}  // namespace

std::unordered_map<const Element*, std::size_t> find_circles(
    std::span<const Element* const> elements,
    const std::function<std::vector<const Element*>(const Element&)>& leads_to) {
  Circles circles(leads_to);
  for (const Element* element : elements) circles.visit(*element);
  return std::move(circles.numbers);
}

}  // namespace nacre
