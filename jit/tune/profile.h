#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/tune/choices.h"
#include "jit/tune/error.h"
#include "runtime/diagnostic.h"

namespace nacre {

struct Tuned;

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

 private:
  std::vector<Subject> subjects_;
};

/// Has options ask for what the profile chose for a material, or for outputs that are one kernel:
/// of each dimension the most exact of theirs. What it says nothing of is warned of, and compiled
/// as standard.
void apply_profile(const Profile& profile, const std::vector<std::string>& names, bool is_material,
                   ShaderOptions& options, Diagnostics& diagnostics);

/// Text of a profile, subject by subject.
class ProfileWriter {
 public:
  void add(const std::string& name, bool is_material, const Tuned& tuned, double max_error,
           const Metric& metric);
  std::string text() const;

 private:
  std::vector<std::string> subjects_;  ///< JSON of each.
};

}  // namespace nacre
