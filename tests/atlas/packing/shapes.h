#pragma once
// Small scenes made in code, and what must hold for any atlas of theirs.

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel::test {

/// Scene with one default material (index 0) and no mesh.
Scene empty_scene();

/// Rectangle of width × height in the xy plane from the origin, facing +z; indexed, 4 vertices.
Primitive quad(float width, float height);

/// Axis-aligned box from the origin, 24 vertices, facing outwards.
Primitive box(const glm::vec3& size);

/// Unit sphere with shared vertices and smooth normals.
Primitive sphere(int segments, int rings);

/// Open tube of radius 1 about y, with shared vertices.
Primitive tube(int segments, float height);

/// Helical ramp about y that turns `turns` times: seen from above it lies over itself.
Primitive helix(int steps, float turns);

/// Meshes of scene_of_shapes(): a box, a sphere, and one of a helix and a tube.
enum Shapes { kCube, kBall, kRamp };

/// Scene of these meshes, without instances.
Scene scene_of_shapes();

/// Adds a mesh of these primitives and returns its index.
int add_mesh(Scene& scene, std::vector<Primitive> primitives, const std::string& name = "mesh");

void add_instance(Scene& scene, int mesh, const glm::mat4& transform = glm::mat4(1.0f));

/// Total surface in the world [m²], double-sided ones counted once.
double world_area(const Scene& scene);

/// Sum of the areas of front lumels [m²].
double front_area(const Lumels& lumels);

/// For each texel, the chart that touches it with area, or -1. Reports texels of two charts.
std::vector<int> texel_owners(const Atlas& atlas, int& shared_texels);

}  // namespace lumel::test
