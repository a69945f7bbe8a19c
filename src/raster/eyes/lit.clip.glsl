#ifndef LUMEL_VISIBILITY_LIT_CLIP_GLSL
#define LUMEL_VISIBILITY_LIT_CLIP_GLSL

// Drivers clip at the near plane, and beyond the image's sides only what lies far out. Of a surface
// that passes overhead, the clipped edge would then lie at the near distance, and depths between
// there and what is in view are too far apart to be interpolated. Declares gl_ClipDistance.

out float gl_ClipDistance[4];

void clip_to_face(vec4 at)
{
    gl_ClipDistance[0] = at.w + at.x;
    gl_ClipDistance[1] = at.w - at.x;
    gl_ClipDistance[2] = at.w + at.y;
    gl_ClipDistance[3] = at.w - at.y;
}

#endif
