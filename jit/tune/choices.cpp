#include "jit/tune/choices.h"

#include <algorithm>

#include "jit/tune/dimension.h"

namespace nacre {

Choices exact_choices() { return Choices(dimensions().size(), 0); }

Choices standard_choices() {
  Choices choices = exact_choices();
  const auto accuracy = std::ranges::find(dimensions(), "accuracy", &Dimension::name);
  const auto standard = std::ranges::find(accuracy->settings, "standard");
  choices[static_cast<std::size_t>(accuracy - dimensions().begin())] =
      static_cast<std::size_t>(standard - accuracy->settings.begin());
  return choices;
}

void apply_choices(const Choices& choices, ShaderOptions& options) {
  for (std::size_t i = 0; i < choices.size(); ++i) dimensions()[i].apply(choices[i], options);
}

std::string to_string(const Choices& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == 0) continue;
    const Dimension& dimension = dimensions()[i];
    if (!text.empty()) text += ' ';
    text += std::string(dimension.name) + '=' + std::string(dimension.settings[choices[i]]);
  }
  return text.empty() ? "exact" : text;
}

}  // namespace nacre
