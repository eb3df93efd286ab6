// The steps from 1.22 to 1.26, each of one or two renames.
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

void upgrade_to_1_23(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    if (element->attribute("type") == "vector") {
      upgrade.document.set_attribute(*element, "type", "vector3");
    }
  }
}

void upgrade_to_1_24(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    if (element->category() == "shader") {
      move_attribute(upgrade.document, *element, "shadername", "node");
    }
    if (element->category() == "assign") Document::set_category(*element, "materialassign");
  }
}

void upgrade_to_1_25(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    if (element->category() == "input") {
      move_attribute(upgrade.document, *element, "graphname", "opgraph");
    }
  }
}

void upgrade_to_1_26(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    if (element->category() != "constant") continue;
    if (Element* color = child_named(*element, "color")) {
      rename(upgrade.document, *color, "value");
    }
  }
}

}  // namespace nacre::upgrading
