#ifndef LUMEL_VISIBILITY_LIT_CLIP_GLSL
#define LUMEL_VISIBILITY_LIT_CLIP_GLSL

// Explicit clip distances. Drivers clip at the near plane, and at the image's sides only far
// outside. A clipped edge of a surface overhead would have the near distance, and the depths from
// there to the visible part span too large a range for interpolation. Declares gl_ClipDistance.

out float gl_ClipDistance[4];

void clip_to_face(vec4 at)
{
    gl_ClipDistance[0] = at.w + at.x;
    gl_ClipDistance[1] = at.w - at.x;
    gl_ClipDistance[2] = at.w + at.y;
    gl_ClipDistance[3] = at.w - at.y;
}

#endif
