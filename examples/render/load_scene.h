#pragma once

#include <string>

#include "examples/render/scene.h"
#include "examples/render/scene_limits.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// What is wanted of a scene that may be shown in several ways.
struct SceneLooks {
  bool materials = false;      ///< Scene::materials; otherwise only their names are read.
  std::string variant = {};    ///< Of KHR_materials_variants; "": what the file shows by itself.
  std::string animation = {};  ///< Its name, or its number from 0; "": the first.
};

/// Whether a file is of a format whose materials are read: .glb or .gltf.
bool has_materials(const std::string& path);

/// Reads .glb, .gltf, .hair or .obj, told by the extension. Errors leave the scene
/// without meshes; warnings do not. Every mesh has gone through finish_mesh() or
/// finish_fibres(). What the
/// file has and the host does not render is a warning. What is animated stands as it does while
/// `shutter` is open; what moves meanwhile has `instances`.
Scene load_scene(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics,
                 const Shutter& shutter = {}, const SceneLooks& looks = {});

/// False, with an error, where anything is asked of a scene of one look without animations, which
/// has none to choose from. `path` "": the built-in one.
bool check_looks(const SceneLooks& looks, const std::string& path, Diagnostics& diagnostics);

/// glTF 2.0: the nodes of the default scene (or of the first), triangles,
/// strips and fans, lines with an attribute _RADIUS, any component type, meshes that Draco or
/// meshopt packed. Morph targets and skins bend vertices. glTF puts uv (0,0) at the upper left, so
/// v becomes 1 - v. Without normals faces are flat. Buffers are only read from the folder of the
/// file and below. One of its animations moves nodes.
Scene load_gltf(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics,
                const Shutter& shutter, const SceneLooks& looks);

/// Wavefront OBJ: v, vt, vn, f (any polygon, cut into a fan, negative indices),
/// o, g, usemtl; what else would change the picture is a warning. One mesh per object,
/// group and material.
Scene load_obj(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics);

/// Fibres of a HAIR file (Yuksel): segments, points, thickness and colours ("color0"); transparency
/// is a warning. u goes from fibre to fibre, v along each.
Scene load_hair(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics);

}  // namespace nacre::host
