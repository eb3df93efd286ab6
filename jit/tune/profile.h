#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/tune/choices.h"
#include "jit/tune/tune.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// How materials and outputs are compiled, by name: what tune() chose, in a file that can be kept,
/// compared and applied elsewhere. JSON:
///
///   {"nacre_profile": 1,
///    "subjects": [{"material": "Gold", "choices": {"accuracy": "fast"}, ...what was measured}]}
class Profile {
 public:
  struct Subject {
    std::string name;
    bool is_material = false;
    Choices choices;
  };

  /// Nothing, with a diagnostic, for what is no profile, or names what there is not. Choices that
  /// are not named are exact, but for the accuracy, which is standard.
  static std::optional<Profile> parse(std::string_view text, const std::string& file,
                                      Diagnostics& diagnostics);

  /// Null where the profile says nothing of it.
  const Choices* find(std::string_view name, bool is_material) const;
  /// Of those that it says something of.
  std::vector<std::string> names(bool is_material) const;

 private:
  std::vector<Subject> subjects_;
};

/// Has options ask for what the profile chose for a material, or for outputs that are one kernel:
/// of each dimension the most exact of theirs. What it says nothing of is warned of, and compiled
/// as standard.
void apply_profile(const Profile& profile, const std::vector<std::string>& names, bool is_material,
                   ShaderOptions& options, Diagnostics& diagnostics);

/// What was chosen for one of them.
struct TunedSubject {
  std::string name;
  bool is_material = false;
  Tuned tuned;
};

/// The text of a profile; `options`: what was asked.
std::string profile_text(const std::vector<TunedSubject>& subjects, const TuneOptions& options);

}  // namespace nacre
