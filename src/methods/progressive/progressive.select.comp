#version 460
#include "methods/progressive/progressive.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "solve/transport/patches.glsl"

// Chooses the patches of a batch, [Hoef13] Algorithm 4.2: those of the chart with the most unshot
// power per patch, one after another, then those of the next such chart. The cursor persists
// between batches, without readback. A chart is chosen at most once per batch: the batch sends the
// light that was unshot before it, and what is sent twice is marked as shot once.
//
// Dynamic shooter subdivision, section 4.3.3: a chart shoots at the coarsest level at which no
// patch sends more than a set part of all light. It keeps its level, so that its light can be taken
// back exactly. When it becomes too bright for its level, all its light is taken back and shot
// again at a finer one.
//
// Uniformly distributed light still to arrive is the ambient term of [CCWG88] section 4; its
// arriving and reflected fractions are those of the light shot so far.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { ChooseParams p; };
layout(scalar) readonly buffer Charts { PatchChart charts[]; };
layout(scalar) coherent buffer Lights { ChartLight lights[]; };
layout(scalar) coherent buffer Levels { uint levels[]; };
layout(scalar) buffer Cursors { Cursor kept_cursor; };
layout(scalar) writeonly buffer Chosen { ChosenPatch chosen[]; };
layout(scalar) writeonly buffer Ambient { vec3 ambient; };

#include "methods/progressive/progressive.chart_light.glsl"

// Refine a chart when a patch exceeds its power limit by this factor.
const float kTooBright = 8.0;

// Maximum assumed fraction of shot light that is reflected: 1 / (1 - it) stays finite.
const float kMaxReflected = 0.98;

vec3 ambient_of(ChartLight sum)
{
    const vec3 sent = max(sum.shot, vec3(1e-30));
    const vec3 arriving = clamp(sum.arrived / sent, 0.0, 1.0);
    const vec3 reflected = clamp(sum.reflected / sent, 0.0, kMaxReflected);
    return sum.unshot * arriving / ((1.0 - reflected) * p.area);
}

shared Cursor cursor;
shared float patch_power;  // limit of a patch's power [lm]
shared float best_gain[kPatchGroup];
shared uint best_chart[kPatchGroup];

uint level_for(PatchChart chart, float chart_power)
{
    uint level = 0u;
    for (uint l = 0u; l < p.finest; ++l)
        if (chart_power > patch_power * float(max(patches_of(chart, l), 1u)))
            level = l + 1u;
    return level;
}

float gain_of(uint c)
{
    const PatchChart chart = charts[c];
    const uint level = levels[c] == kNoLevel ? level_for(chart, lights[c].power) : levels[c];
    return lights[c].power / float(max(patches_of(chart, level), 1u));
}

void find_best(uint me)
{
    float gain = 0.0;
    uint best = kNoPatch;
    for (uint c = me; c < p.charts; c += kPatchGroup) {
        const float here = gain_of(c);
        if (here > gain) {
            gain = here;
            best = c;
        }
    }
    best_gain[me] = gain;
    best_chart[me] = best;
    barrier();
    for (uint width = kPatchGroup / 2u; width > 0u; width /= 2u) {
        if (me < width && best_gain[me + width] > best_gain[me]) {
            best_gain[me] = best_gain[me + width];
            best_chart[me] = best_chart[me + width];
        }
        barrier();
    }
}

void begin_chart(uint c)
{
    const PatchChart chart = charts[c];
    const uint wanted = level_for(chart, lights[c].power);
    cursor.send = kSendUnshot;
    if (levels[c] == kNoLevel) {
        levels[c] = wanted;
    } else if (wanted > levels[c] &&
               lights[c].power > kTooBright * patch_power * float(patches_of(chart, levels[c]))) {
        cursor.send = kSendBack;
    }
    cursor.chart = c;
    cursor.level = levels[c];
    cursor.next = 0u;
    cursor.count = patches_of(chart, cursor.level);
    if (cursor.send == kSendBack)
        levels[c] = wanted;
    lights[c].power = 0.0;
}

// All points of a lumel shoot in one batch.
bool fits(uint k)
{
    const uint points = points_per_lumel(cursor.level);
    return cursor.next % points != 0u || k + points <= p.batch;
}

void main()
{
    const uint me = gl_LocalInvocationID.x;
    ChartLight mine = no_light();
    for (uint c = me; c < p.charts; c += kPatchGroup)
        mine = plus(mine, lights[c]);
    const ChartLight sum = add_over_group(mine);
    if (me == 0u) {
        cursor = kept_cursor;
        if (cursor.next < cursor.count)
            lights[cursor.chart].power = 0.0;
        ambient = ambient_of(sum);
        patch_power = p.patch_share * max(luminance(sum.shot + sum.unshot), 1e-30);
    }
    memoryBarrierBuffer();
    barrier();
    for (uint k = 0u; k < p.batch; ++k) {
        if (cursor.next >= cursor.count) {
            find_best(me);
            if (me == 0u && best_chart[0] != kNoPatch)
                begin_chart(best_chart[0]);
        }
        memoryBarrierBuffer();  // power and level of the chart that began
        barrier();
        if (me == 0u) {
            const bool any = cursor.next < cursor.count && fits(k);
            chosen[k] = ChosenPatch(any ? cursor.chart : kNoPatch, cursor.level, cursor.next,
                                    cursor.send);
            cursor.next += any ? 1u : 0u;
        }
        barrier();
    }
    if (me == 0u)
        kept_cursor = cursor;
}
