#include "bench/papers/runs.h"

namespace lumel::bench {
namespace {

constexpr Run kRuns[] = {
    {"iterations", "Time of an iteration, hemicubes",
     "A whole iteration with one shooter, the fastest of three stretches. Nothing is read back but "
     "four bytes.",
     "iterations --sizes 64,128,512 --iterations 8", "iterations",
     "iterations --sizes 16,32 --vertices 10,100 --iterations 4 --hemicube 32"},
    {"iterations-hemisphere", "Time of an iteration, hemispheres",
     "The same through one hemisphere instead of a hemicube, as [BJ04] does.",
     "iterations --projection hemisphere --sizes 64,128,512 --iterations 8",
     "iterations --projection hemisphere",
     "iterations --projection hemisphere --sizes 16,32 --vertices 10,100 --iterations 4 "
     "--hemicube 32"},
    {"selection", "Drawing a shooter",
     "Wall time of a draw by read-back and linear search, and by sums on the device; the rest of "
     "an iteration is without either.",
     "selection --sizes 64,128,512", "selection", "selection --sizes 16 --draws 4 --hemicube 32"},
    {"convergence", "Error after iterations, diffuse",
     "Error of the map after the iterations of a row, nothing finished or filtered, free of the "
     "noise "
     "of the paths. [BJ04] sends the running average (Eq. 2), through a hemisphere, [BSS05] the "
     "last "
     "iteration (Eqs. 4, 5), with merged texels (Eq. 8).",
     "convergence --size 64 --reference-spp 2048 --width 160 -o {out}",
     "convergence --reference-spp 4096 -o {out}",
     "convergence --size 16 --iterations 1,50,80 --hemicube 32 --reference-spp 16 --width 16 "
     "-o {out}"},
    {"convergence-glossy", "Error after iterations, glossy",
     "The same of arriving light in a glossy scene. The default sends sixteen shooters and the "
     "particles of lobes in an iteration, [BSS05] one shooter.",
     "convergence scenes/glossy-cornell-box.gltf --solver glossy --size 64 --reference-spp 2048 "
     "--width 160 -o {out}",
     "convergence scenes/glossy-cornell-box.gltf --solver glossy --reference-spp 4096 -o {out}",
     "convergence scenes/glossy-cornell-box.gltf --solver glossy --size 16 --iterations 1,80 "
     "--hemicube 32 --reference-spp 16 --width 16 -o {out}"},
    {"visibility", "What a shooter sees",
     "The patch of every texel, and the depth image of a hemisphere.", "visibility -o {out}",
     "visibility --size 512 -o {out}", "visibility --size 16 --hemicube 32 -o {out}"},
    {"glossy-pictures", "Glossy pictures with their times",
     "A whole picture from its scene, charts and visibility included. The default takes as many "
     "shooters again for the eye. Error over pixels that show no lamp, against paths.",
     "glossy-pictures --width 160 --paths 64 -o {out}", "glossy-pictures -o {out}",
     "glossy-pictures --size 32 --iterations 2 --width 16 --paths 2 --hemicube 32 -o {out}"},
    {"ablation", "Variance with and without its remedies",
     "Variance between seeds, not an error against a truth. Processor time of the eye's stages "
     "only; the solution before them is the same.",
     "ablation --size 64 --seeds 3 --solving-shots 1024 --shots 256", "ablation",
     "ablation --size 16 --seeds 2 --width 16 --solving-shots 64 --shots 32 --rays 2 "
     "--iterations 4 --hemicube 32"},
    {"frames", "Frames that have much in common",
     "Error of the map of each frame against paths. Processor time of a frame's iterations; near "
     "field, rays and upload of the moved scene are the same for all.",
     "frames --frames 4 --reference-spp 1024", "frames --size 128 --frames 12",
     "frames --size 16 --hemicube 32 --frames 2 --iterations 16 --reference-spp 4"},
    {"layers", "Stochastic layers",
     "Excess of red over green on the plane on top after all directions, on its lower side, where "
     "light may leak. The distances and albedos of the planes are ours: the paper does not give "
     "its own.",
     "layers --size 64 --directions 1000 --views 2 --lookup-test paper -o {out}",
     "layers --size 64 --lookup-test paper -o {out}",
     "layers --size 16 --map-side 64 --directions 4 --overdraw 1,4 --slabs 1,2 --views 1 -o {out}"},
    {"leak", "Leaky integration",
     "Error of the running solution after the directions of a row, against a mean of many.",
     "leak --size 48 --map-side 256", "leak", "leak --size 16 --map-side 64 --directions 4,8"},
    {"directions", "Scenes lit by global directions",
     "Wall time of a direction, its map and the gathering. Errors are against exact layers and the "
     "same directions, by the paper's test and by ours of planes. Lists are what a bake takes. "
     "The error of our default is against that list too, so that it has the noise of its "
     "directions.",
     "directions --scenes cubes,balls,sky,lamp,landscape --size 128 --map-side 512 --directions "
     "256 "
     "--width 240 -o {out}",
     "directions --size 128 --map-side 256 -o {out}",
     "directions --scenes cubes,balls,sky,lamp,landscape --size 32 --map-side 64 --directions 4 "
     "--width 16 -o {out}"},
    {"moves", "A box that turns",
     "An update, from the move until 0.01 % of all light is unshot, and of its "
     "redistribution alone: the median of the moves, or of the solutions from scratch, after the "
     "first; a table of errors for either state. Errors are of the lumels' "
     "irradiance; the thesis has them of pictures.",
     "dynamic --hemicube 64 --size 64 --low-size 32 --steps 3 --residual 0.0001 --reference-spp "
     "512 "
     "--no-gather --pieces 1 --width 200 -o {out}",
     "dynamic --hemicube 64 --residual 0.0001 --no-gather --pieces 1 -o {out}",
     "dynamic --size 16 --low-size 16 --hemicube 16 --steps 1 --reference-spp 4 "
     "--residual 0.1 --no-gather --pieces 1 --width 16 -o {out}"},
    {"cross-shares", "What keeps cross from a solution from scratch",
     "After the last move, at rest. Rows below the first change one setting, of cross alone or of "
     "both; the last two are against a progressive solution with finer hemicubes and more "
     "shooters.",
     "cross-shares --scenes low --hemicube 64 --low-size 32 --steps 1",
     "cross-shares --hemicube 64",
     "cross-shares --scenes low --low-size 16 --low-hemicube 16 "
     "--low-shooters 8 --steps 1 --residual 0.1"},
    {"gather", "A box that turns, with gathering",
     "The same with gathering, which goes on until its error is estimated at 2 %.",
     "dynamic --scenes large,small,low --hemicube 64 --size 24 --low-size 16 --steps 1 "
     "--reference-spp 512 --pieces 1",
     "dynamic --hemicube 64 --pieces 1",
     "dynamic --size 16 --low-size 16 --hemicube 16 --steps 1 --reference-spp 4 --residual 0.1 "
     "--pieces 1"},
    {"vertices", "A box that turns, more vertices",
     "Time until at rest, with edges cut into pieces over that with whole edges; the lumels "
     "are the same.",
     "dynamic --scenes large,low --hemicube 64 --size 64 --low-size 32 --steps 1 --no-gather "
     "--reference-spp 0 --pieces 14",
     "dynamic --hemicube 64 --no-gather --reference-spp 0",
     "dynamic --scenes large,low --size 16 --low-size 16 --hemicube 16 --steps 1 --no-gather "
     "--reference-spp 0 --residual 0.1 --pieces 2,3"},
    {"drift", "Many moves", "Error at rest after the moves of a row.",
     "drift --size 24 --hemicube 32 --moves 100", "drift --size 24 --hemicube 32 --moves 1000",
     "drift --size 16 --hemicube 16 --residual 0.1 --moves 2"},
    {"matrix", "Form-factor matrices",
     "Bytes of the file. Errors of indirect light over patches by their area against the matrix "
     "before it was compressed.",
     "matrix --size 64 --patches 1024 --reference-spp 2048 -o {out}", "matrix -o {out}",
     "matrix --size 16 --patches 64 --lights 2 --hemicube 32 --reference-spp 16 --width 16 "
     "-o {out}"},
    {"matrix-speed", "One multiply against many bounces",
     "The multiply alone, for three colours at once, the fastest of three stretches. "
     "Naive radiosity reads the form factors, as floats without colours, once for each of 8 "
     "bounces, through the same kernel. Errors are of one state of light against all bounces.",
     "matrix-speed --large 4096 --growth 1000,2000",
     "matrix-speed --large 8192 --growth 1000,2000,4000,8000",
     "matrix-speed --size 16 --patches 64 --hemicube 32 --large 64 --growth 64 --repeats 1"},
};

}  // namespace

std::span<const Run> all_runs()
{
    return kRuns;
}

}  // namespace lumel::bench
