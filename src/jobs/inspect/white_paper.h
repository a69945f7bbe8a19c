#pragma once
// Replaces all materials by white diffuse ones, so that renders show irradiance.

#include "scene/values/scene.h"

namespace lumel {

inline Scene white_paper(Scene scene)
{
    for (Material& material : scene.materials)
        material = {.double_sided = material.double_sided};
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            primitive.colors.clear();
    return scene;
}

}  // namespace lumel
