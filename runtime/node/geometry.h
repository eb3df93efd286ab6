#pragma once

#include <string_view>

#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

/// The shading point, as input channels that a kernel asks for by name. Using a
/// function makes the kernel require the channels; a host supplies no others.
///
///   P.x P.y P.z        position, world space           Po.*  object space
///   N.*                shading normal, unit, world     No.*  object space
///   T.* B.*            tangent, bitangent, unit, world To.* Bo.* object space
///   Ng.*               geometric normal, unit, world
///   uv0.x uv0.y        texture coordinates, set 0, 1, ...
///   color0.x ... .w    vertex colour, set 0, 1, ...
///   wo.*               unit direction from the point to the viewer, world
///   dPdx.* ...         footprint derivatives of P, Po, N, uv0: see jit/passes/derive.h
///   geomprop.NAME.x    a named geometric property, up to .w; integers and booleans
///                      as i32 and b1 channels of the same form
///
/// The model space of MaterialX is the object space here, as in its own generators.
enum class Space { world, object };

/// "world", "object", "model"; anything else is object, the nodedefs' default.
Space parse_space(std::string_view name);

Float3 position(Recorder& recorder, Space space);
Float3 normal(Recorder& recorder, Space space);
Float3 tangent(Recorder& recorder, Space space);
Float3 bitangent(Recorder& recorder, Space space);
Float3 geometric_normal(Recorder& recorder);
Float2 texcoord(Recorder& recorder, int set);
/// Unit direction from the point towards the viewer, world space.
Float3 view_direction(Recorder& recorder);

/// Channel "<group>.<component>", component 0..3 as x, y, z, w.
Ref channel(Recorder& recorder, std::string_view group, int component, Scalar type = Scalar::f32);
Float3 channel3(Recorder& recorder, std::string_view group);

/// Uniform slots that a host may set; names and meaning:
///   frame, time              frame number (1.0) and seconds (0.0)
///   object_to_world.0 ... 15 row-major, row vectors on the left (identity)
///   world_to_object.0 ... 15 its inverse
Float uniform(Recorder& recorder, std::string_view name, float value);

}  // namespace nacre
