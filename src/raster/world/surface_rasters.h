#pragma once
// A pair of raster passes: for opaque surfaces, and for those with alpha.

#include "gpu/pipeline.h"

namespace lumel {

template <class Opaque, class CutOut>
struct SurfaceRasters {
    explicit SurfaceRasters(const gpu::Device& device, const gpu::RasterOptions& options = {})
        : opaque(device, options),
          cut_out(device, options)
    {
    }

    gpu::Raster<Opaque> opaque;
    gpu::Raster<CutOut> cut_out;
};

}  // namespace lumel
