#pragma once
// The scene as if it were of white paper: what a picture of it shows is the light that arrives.

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
