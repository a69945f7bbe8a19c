#pragma once
// Where on a lumel light is received.

namespace lumel {

enum class SampleRule { area, centre };

}  // namespace lumel
