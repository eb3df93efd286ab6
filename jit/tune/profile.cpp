#include "jit/tune/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jit/tune/dimension.h"
#include "jit/tune/json.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;

std::string names_of_dimensions() {
  std::string names;
  for (const Dimension& each : dimensions()) {
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  }
  return names;
}

/// Reads one document, and says what is wrong with it.
class Reader {
 public:
  Reader(const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  std::optional<Profile::Subject> subject(const Json& json) {
    Profile::Subject made;
    if (!json.is_object()) return refuse({}, "a subject is an object", "{...}", json.type_name());
    for (const char* kind : {"material", "output"}) {
      const auto name = json.find(kind);
      if (name == json.end()) continue;
      if (!name->is_string())
        return refuse(kind, "a subject has a name", "a text", name->type_name());
      made.name = name->get<std::string>();
      made.is_material = std::string_view(kind) == "material";
    }
    if (made.name.empty()) {
      return refuse({}, "a subject has a name", "\"material\" or \"output\"", "neither");
    }
    made.choices = standard_choices();
    const auto choices = json.find("choices");
    if (choices == json.end() || !choices->is_object()) {
      return refuse(made.name, "a subject has choices", "\"choices\": {...}", "none");
    }
    for (const auto& [name, setting] : choices->items()) {
      if (!choose(made, name, setting)) return std::nullopt;
    }
    return made;
  }

  std::nullopt_t refuse(const std::string& path, const std::string& message,
                        const std::string& expected, const std::string& found) {
    diagnostics_.error("bad-profile", {.file = file_, .path = path}, message, expected, found);
    return std::nullopt;
  }

 private:
  bool choose(Profile::Subject& subject, const std::string& name, const Json& setting) {
    const auto all = dimensions();
    const auto dimension = std::ranges::find(all, name, &Dimension::name);
    if (dimension == all.end()) {
      refuse(subject.name, "there is no such choice", names_of_dimensions(), name);
      return false;
    }
    const auto settings = dimension->settings;
    const auto found = setting.is_string() ? std::ranges::find(settings, setting.get<std::string>())
                                           : settings.end();
    if (found == settings.end()) {
      refuse(subject.name + '/' + name, "there is no such setting",
             fmt::format("{}", fmt::join(settings, ", ")), setting.dump());
      return false;
    }
    subject.choices[static_cast<std::size_t>(dimension - all.begin())] =
        static_cast<std::size_t>(found - settings.begin());
    return true;
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Profile> Profile::parse(std::string_view text, const std::string& file,
                                      Diagnostics& diagnostics) {
  Reader reader(file, diagnostics);
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    return reader.refuse({}, "this is no profile", "a JSON object", json.type_name());
  }
  const auto said = json.find("nacre_profile");
  if (said == json.end() || *said != version) {
    return reader.refuse({}, "this is no profile that is known here",
                         fmt::format("\"nacre_profile\": {}", version),
                         said == json.end() ? "none" : said->dump());
  }
  const auto subjects = json.find("subjects");
  if (subjects == json.end() || !subjects->is_array()) {
    return reader.refuse({}, "a profile has a list of subjects", "\"subjects\": [...]", "none");
  }
  Profile made;
  for (const Json& each : *subjects) {
    std::optional<Subject> subject = reader.subject(each);
    if (!subject) return std::nullopt;
    if (made.find(subject->name, subject->is_material) != nullptr) {
      return reader.refuse(subject->name, "a subject is there once", "one of a name", "two");
    }
    made.subjects_.push_back(std::move(*subject));
  }
  return made;
}

const Choices* Profile::find(std::string_view name, bool is_material) const {
  const auto found = std::ranges::find_if(subjects_, [&](const Subject& each) {
    return each.name == name && each.is_material == is_material;
  });
  return found == subjects_.end() ? nullptr : &found->choices;
}

std::vector<std::string> Profile::names(bool is_material) const {
  std::vector<std::string> all;
  for (const Subject& each : subjects_) {
    if (each.is_material == is_material) all.push_back(each.name);
  }
  return all;
}

void apply_profile(const Profile& profile, const std::vector<std::string>& names, bool is_material,
                   ShaderOptions& options, Diagnostics& diagnostics) {
  std::optional<Choices> all;
  for (const std::string& name : names) {
    const Choices* const found = profile.find(name, is_material);
    if (found == nullptr) {
      diagnostics.warning("not-in-profile", {.file = {}, .path = name},
                          "the profile says nothing of this, which is compiled as standard",
                          is_material ? "a material of the profile" : "an output of the profile",
                          name, near_hint(diagnostics, name, profile.names(is_material)));
    }
    const Choices choices = found != nullptr ? *found : standard_choices();
    if (!all) all = choices;
    for (std::size_t i = 0; i < choices.size(); ++i) (*all)[i] = std::min((*all)[i], choices[i]);
  }
  if (all) apply_choices(*all, options);
}

std::string profile_text(const std::vector<TunedSubject>& subjects, const TuneOptions& options) {
  const Metric& metric = options.metric;
  const Json asked{{"max_error", options.max_error},
                   {"metric", metric.is_relative ? "relative" : "absolute"},
                   {"floor", metric.floor}};
  Json list = Json::array();
  for (const auto& [name, is_material, tuned] : subjects) {
    const Candidate& chosen = tuned.chosen;
    list.push_back({{is_material ? "material" : "output", name},
                    {"choices", as_json(chosen.choices)},
                    {"asked", asked},
                    {"error", as_json(chosen.error)},
                    {"unseen_error", as_json(chosen.unseen_error.value_or(Error()))},
                    {"points", tuned.points},
                    {"cost", chosen.cost},
                    {"standard_cost", tuned.standard.cost}});
  }
  const Json json{{"nacre_profile", version}, {"subjects", std::move(list)}};
  // Names come from documents, which may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace nacre
