#pragma once
// Receiving points of a lumel: distributed over its area, or its centroid.

namespace lumel {

enum class SampleRule { area, centre };

}  // namespace lumel
