#pragma once

#include <vector>

#include "examples/render/scene.h"

namespace nacre::host {

/// The mean curvature H of a mesh at its vertices, 1 per unit of length in world space, positive
/// where it is convex: 1/r on a sphere of radius r, 1/2r on a cylinder. `to_world`: where the
/// vertices are not in world space, their map.
///
/// Over a triangle with edges e1, e2 from a corner and the differences n1, n2 of the corners'
/// normals along them, the shape operator takes e to n, and H is half its trace:
///
///   H = (n1.e1 e2.e2 - (n1.e2 + n2.e1) e1.e2 + n2.e2 e1.e1) / (2 |e1 x e2|^2)
///
/// (Rusinkiewicz 2004, "Estimating Curvatures and Their Derivatives on Triangle Meshes", section 3:
/// the second fundamental form of a face by finite differences of normals). A vertex has the mean
/// of the triangles around, by their areas; vertices at one place with one normal are one. So an
/// edge whose sides have normals of their own has none.
std::vector<float> mean_curvature(const Mesh& mesh, const Affine& to_world);

}  // namespace nacre::host
