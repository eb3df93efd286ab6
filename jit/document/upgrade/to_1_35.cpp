#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

/// `matrix` is matrix44, `default` is `value`, and a material assignment says the
/// material beside its own name.
void upgrade_to_1_35(const Upgrade& upgrade) {
  Document& document = upgrade.document;
  for (Element* element : elements_of(upgrade.root)) {
    if (element->attribute("type") == "matrix") {
      document.set_attribute(*element, "type", "matrix44");
    }
    if (!element->has_attribute("value")) {
      move_attribute(document, *element, "default", "value");
    }
    if (element->category() == "materialassign" && !element->has_attribute("material")) {
      document.set_attribute(*element, "material", element->name());
    }
  }
}

}  // namespace nacre::upgrading
