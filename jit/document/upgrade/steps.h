#pragma once

#include <functional>

#include "jit/document/upgrade/rewrite.h"

namespace nacre::upgrading {

// Each brings a file of the version before to that version; what changed is in
// the reference's Document::upgradeVersion and in the specifications' "Changes"
// sections. A file is taken through all steps that are later than its version.

void upgrade_to_1_23(const Upgrade& upgrade);
void upgrade_to_1_24(const Upgrade& upgrade);
void upgrade_to_1_25(const Upgrade& upgrade);
void upgrade_to_1_26(const Upgrade& upgrade);
void upgrade_to_1_34(const Upgrade& upgrade);
void upgrade_to_1_35(const Upgrade& upgrade);
void upgrade_to_1_36(const Upgrade& upgrade);
void upgrade_to_1_37(const Upgrade& upgrade);
void upgrade_to_1_38(const Upgrade& upgrade);
void upgrade_to_1_39(const Upgrade& upgrade);

// Parts of the step to 1.38, in their order.

/// color2 becomes vector2, its channels r and a become x and y.
void replace_color2(const Upgrade& upgrade);
/// <material> with its <shaderref>s becomes shader nodes and a material node.
void replace_materials(const Upgrade& upgrade);
/// BSDF nodes get the names and inputs they have since.
void rename_closures(const Upgrade& upgrade);

// Parts of the step to 1.39, in their order.

/// `channels` of a port becomes a swizzle node.
void replace_channels(const Upgrade& upgrade);
/// thin_film_bsdf on top of a layer becomes inputs of the closures below it.
void replace_thin_film(const Upgrade& upgrade);
/// swizzle becomes constant, extract, convert, combine, or separate and combine.
void replace_swizzle(const Upgrade& upgrade);
/// normalmap: no `space`, and a bitangent that goes with a given normal or tangent.
void replace_normalmap(const Upgrade& upgrade);

/// The nodedef a <shaderref> names, if the file holds it; else null.
Element* nodedef_of_shaderref(const Upgrade& upgrade, const Element& shaderref);

/// What to do with an input of a shader's nodedef that the shaderref leaves unbound.
using UnboundInput = std::function<void(Element& shaderref, const Element& input)>;
/// Calls it for all of a material, until the upgrade's work is spent.
void visit_unbound_inputs(const Upgrade& upgrade, Element& material, const UnboundInput& visit);

}  // namespace nacre::upgrading
