#include "rays/cast/device_triangles.h"

#include <algorithm>

#include "rays/cast/ray_caster.h"

namespace lumel {

DeviceTriangles::DeviceTriangles(const RayScene& rays)
{
    for (const bool passable : {false, true}) {
        for (std::size_t part = 0; part < rays.parts(); ++part)
            if (rays.may_let_pass(part) == passable) {
                parts_.push_back(part);
                before_.push_back(count_);
                count_ += std::uint32_t(rays.corners(part).size() / 3);
            }
        if (!passable)
            solid_ = count_;
    }
}

DeviceTriangles::Place DeviceTriangles::place(std::uint32_t triangle) const
{
    const auto next = std::upper_bound(before_.begin(), before_.end(), triangle);
    const auto n = std::size_t(next - before_.begin()) - 1;
    return {parts_[n], triangle - before_[n]};
}

RayHit DeviceTriangles::hit(const RayScene& rays, const RaySpan& ray, const DeviceHit& found) const
{
    if (found.triangle >= solid_) {
        RayHit hit;
        if (!rays.closest(ray, hit))
            hit.distance = RayCaster::kNothing;
        return hit;
    }
    const auto [part, triangle] = place(found.triangle);
    return rays.hit(part, triangle, found.barycentric, found.distance, ray.direction);
}

DeviceTriangles::Mesh DeviceTriangles::mesh(const RayScene& rays) const
{
    Mesh mesh;
    for (const std::size_t part : parts_) {
        const auto first = std::uint32_t(mesh.positions.size());
        const std::vector<glm::vec3> own = rays.positions(part);
        mesh.positions.insert(mesh.positions.end(), own.begin(), own.end());
        for (const std::uint32_t corner : rays.corners(part))
            mesh.corners.push_back(first + corner);
    }
    return mesh;
}

}  // namespace lumel
