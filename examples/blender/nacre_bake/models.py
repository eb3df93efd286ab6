"""Which inputs of a shading model each socket of the Principled BSDF is made of.

Blender's manual says what its sockets are, Cycles' kernel/svm/closure_principled.h how they act.
"""

from typing import NamedTuple


class Product(NamedTuple):
    inputs: tuple[str, ...]  # Multiplied; of a colour for a number its luminance.
    factor: float = 1.0


def of(*inputs: str, factor: float = 1.0) -> Product:
    return Product(inputs, factor)


class Model(NamedTuple):
    sockets: dict[str, Product]
    # "Base Color" is the first, but what is transmitted or goes below the surface has the colour of
    # another input by that share. Light meets a transmission colour on its way in and out.
    base: Product
    transmission: tuple[str, str] | None = None
    subsurface: tuple[str, str] | None = None
    # Read elsewhere, or without a meaning where others are as they are.
    also: tuple[str, ...] = ()


# Principled: the ratio of the facets' roughness is 1 - 0.9 "Anisotropic". MaterialX: 1 - anisotropy.
ANISOTROPIC = 1 / 0.9

STANDARD_SURFACE = Model(
    base=of("base", "base_color"),
    transmission=("transmission", "transmission_color"),
    subsurface=("subsurface", "subsurface_color"),
    sockets={
        "Metallic": of("metalness"),
        "Roughness": of("specular_roughness"),
        "IOR": of("specular_IOR"),
        "Diffuse Roughness": of("diffuse_roughness"),
        "Specular IOR Level": of("specular", factor=0.5),
        "Specular Tint": of("specular_color"),
        "Anisotropic": of("specular_anisotropy", factor=ANISOTROPIC),
        "Anisotropic Rotation": of("specular_rotation"),
        "Transmission Weight": of("transmission"),
        "Subsurface Weight": of("subsurface"),
        "Subsurface Radius": of("subsurface_radius"),
        "Subsurface Scale": of("subsurface_scale"),
        "Subsurface Anisotropy": of("subsurface_anisotropy"),
        "Coat Weight": of("coat"),
        "Coat Roughness": of("coat_roughness"),
        "Coat IOR": of("coat_IOR"),
        "Coat Tint": of("coat_color"),
        "Coat Normal": of("coat_normal"),
        "Sheen Weight": of("sheen"),
        "Sheen Roughness": of("sheen_roughness"),
        "Sheen Tint": of("sheen_color"),
        "Thin Film Thickness": of("thin_film_thickness"),
        "Thin Film IOR": of("thin_film_IOR"),
        "Emission Color": of("emission_color"),
        "Emission Strength": of("emission"),
        "Alpha": of("opacity"),
        "Normal": of("normal"),
    })

OPEN_PBR = Model(
    base=of("base_weight", "base_color"),
    transmission=("transmission_weight", "transmission_color"),
    subsurface=("subsurface_weight", "subsurface_color"),
    sockets={
        "Metallic": of("base_metalness"),
        "Roughness": of("specular_roughness"),
        "IOR": of("specular_ior"),
        "Diffuse Roughness": of("base_diffuse_roughness"),
        "Specular IOR Level": of("specular_weight", factor=0.5),
        "Specular Tint": of("specular_color"),
        "Anisotropic": of("specular_roughness_anisotropy", factor=ANISOTROPIC),
        "Transmission Weight": of("transmission_weight"),
        "Subsurface Weight": of("subsurface_weight"),
        "Subsurface Radius": of("subsurface_radius_scale"),
        "Subsurface Scale": of("subsurface_radius"),
        "Subsurface Anisotropy": of("subsurface_scatter_anisotropy"),
        "Coat Weight": of("coat_weight"),
        "Coat Roughness": of("coat_roughness"),
        "Coat IOR": of("coat_ior"),
        "Coat Tint": of("coat_color"),
        "Coat Normal": of("geometry_coat_normal"),
        "Sheen Weight": of("fuzz_weight"),
        "Sheen Roughness": of("fuzz_roughness"),
        "Sheen Tint": of("fuzz_color"),
        "Thin Film Thickness": of("thin_film_weight", "thin_film_thickness", factor=1000),
        "Thin Film IOR": of("thin_film_ior"),
        "Emission Color": of("emission_color"),
        "Emission Strength": of("emission_luminance"),
        "Alpha": of("geometry_opacity"),
        "Normal": of("geometry_normal"),
    })

GLTF_PBR = Model(
    base=of("base_color"),
    transmission=("transmission", "base_color"),
    also=("thickness",),
    sockets={
        "Metallic": of("metallic"),
        "Roughness": of("roughness"),
        "IOR": of("ior"),
        "Specular IOR Level": of("specular", factor=0.5),
        "Specular Tint": of("specular_color"),
        "Transmission Weight": of("transmission"),
        "Coat Weight": of("clearcoat"),
        "Coat Roughness": of("clearcoat_roughness"),
        "Coat Normal": of("clearcoat_normal"),
        "Sheen Weight": of(),  # A black tint is no sheen.
        "Sheen Roughness": of("sheen_roughness"),
        "Sheen Tint": of("sheen_color"),
        "Thin Film Thickness": of("iridescence", "iridescence_thickness"),
        "Thin Film IOR": of("iridescence_ior"),
        "Emission Color": of("emissive"),
        "Emission Strength": of("emissive_strength"),
        "Alpha": of("alpha"),
        "Normal": of("normal"),
    })

USD_PREVIEW_SURFACE = Model(
    base=of("diffuseColor"),
    sockets={
        "Metallic": of("metallic"),
        "Roughness": of("roughness"),
        "IOR": of("ior"),
        "Coat Weight": of("clearcoat"),
        "Coat Roughness": of("clearcoatRoughness"),
        "Emission Color": of("emissiveColor"),
        "Emission Strength": of(),
        "Alpha": of("opacity"),
        "Normal": of("normal"),
    })

MODELS = {
    "standard_surface": STANDARD_SURFACE,
    "open_pbr_surface": OPEN_PBR,
    "gltf_pbr": GLTF_PBR,
    "UsdPreviewSurface": USD_PREVIEW_SURFACE,
}
