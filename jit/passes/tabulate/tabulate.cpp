#include "jit/passes/tabulate/tabulate.h"

#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/tabulate/groups.h"
#include "jit/passes/tabulate/plan.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"

namespace nacre {

Program tabulate(const Program& program, double error) {
  Program marked = program;
  mark_varying(marked);
  const Groups groups(marked);
  const std::vector<Looked> all = plan_all(marked, groups, error);
  if (all.empty()) return program;
  const Function& entry = marked.entry();
  std::unordered_map<ValueId, std::pair<const Looked*, std::size_t>> looked;
  std::unordered_map<ValueId, Ref> keys;
  for (const Looked& group : all) {
    keys[group.key] = {};
    for (std::size_t k = 0; k < group.values.size(); ++k) looked[group.values[k]] = {&group, k};
  }
  const auto replace = [&](Recorder& recorder, const Instruction& instruction,
                           std::span<const Ref> operands) -> std::optional<Ref> {
    const auto value = static_cast<ValueId>(&instruction - entry.code.data());
    if (&instruction < entry.code.data() || value >= entry.code.size()) return std::nullopt;
    const auto key = keys.find(value);
    std::optional<Ref> made;
    if (const auto found = looked.find(value); found != looked.end()) {
      const auto& [group, function] = found->second;
      made = record_looked(recorder, marked, groups, *group, function, keys.at(group->key));
    } else if (key != keys.end()) {
      made = recorder.emit(instruction.op, operands, instruction.imm);
    }
    if (key != keys.end()) key->second = *made;
    return made;
  };
  Program made = transform(marked, replace);
  mark_varying(made);
  return made;
}

}  // namespace nacre
