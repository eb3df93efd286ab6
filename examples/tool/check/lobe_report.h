#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "examples/tool/check/lobe_laws.h"

namespace nacre::tool {

/// Prints what leaves of the light from each view of what is called `title`; "no closure" of
/// what has none.
void print_views(const std::string& title, const LobeFindings& findings);

/// Views and faults.
nlohmann::ordered_json to_json(const LobeFindings& findings);

/// What is known of one law after lobes were tried with several sets of inputs.
struct LawResult {
  std::string law;
  enum class State { holds, broken, not_tried } state = State::holds;
  std::string figure;   ///< What is nearest to breaking it, or does; may be empty.
  std::size_t set = 0;  ///< Where it is broken: the first that breaks it, from 0.
};

/// All laws, in order.
std::vector<LawResult> try_laws(const std::vector<LobeFindings>& sets);

/// A line for each law, and for reciprocity, which is no law.
void print_laws(const std::string& title, const std::vector<LobeFindings>& sets,
                const std::vector<LawResult>& laws);

}  // namespace nacre::tool
